// A message that is passed between the vehicle's line and that of the ground stations, as it was said.
//
// godwit does not read what is in it, or has read it and let it pass: what may pass is decided where it comes in
// (actors/vehicle_link/relay_gate.hpp, actors/ground_port/passing/table.hpp). It is numbered and signed anew on the
// other line, and keeps who said it. Thread: plain values.
#pragma once

#include <cstdint>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::vehicle_link {

struct relayed_frame {
  std::uint32_t message = 0;  // MAVLink's id of it
  std::uint8_t system = 0;    // who said it
  std::uint8_t component = 0; // the same
  std::vector<std::uint8_t> payload;
  GODWIT_FIELDS(relayed_frame, "vehicle_link.relayed_frame", message, system, component, payload);
  friend bool operator==(const relayed_frame&, const relayed_frame&) = default;
};

} // namespace godwit::vehicle_link
