// What can be set about operators. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::operator_bridge {

struct settings {
  std::int64_t session_idle_s = 1'800;  // without a word for so long, a session ends
  std::int64_t session_most_s = 43'200; // and after so long whatever is done in it: a long day
  GODWIT_FIELDS(settings, "operator_bridge.settings", session_idle_s, session_most_s);
};

} // namespace godwit::operator_bridge
