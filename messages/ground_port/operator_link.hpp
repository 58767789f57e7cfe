// Whether the human's ground station is heard: what the failsafe about a lost operator goes by.
//
// Heard means a heartbeat of a station that says that it is one (MAV_TYPE_GCS), and that may be believed where the link
// is signed. Told once a second, so that a listener also notices when ground_port itself is silent. What the age means
// (degraded, lost, never seen) is the listener's to decide. It has to remember
// that one was ever heard, and to go on counting: a port that was restarted knows nothing of its earlier life. Thread:
// plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::ground_port {

struct operator_link {
  bool ever_heard = false;
  std::int64_t age_ms = -1;   // since the last heartbeat of any station; -1: never heard
  std::uint32_t stations = 0; // heard within the last 5 s
  GODWIT_FIELDS(operator_link, "ground_port.operator_link", ever_heard, age_ms, stations);
};

} // namespace godwit::ground_port
