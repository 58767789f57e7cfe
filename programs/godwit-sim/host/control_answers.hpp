// What the control port answers:
//
//   {"do": "status"}                          the first `status_page` vehicles; {"first": 101} from the 101st on
//   {"do": "status", "vehicle": 2}            one; vehicles are numbered from 1
//   {"do": "cut 5s", "vehicle": 2}            a fault in the words of fault.hpp, for one vehicle or for all
//   {"do": "quit"}                            ends the program
//
// An answer has "ok", and "error" with a sentence where that is false. Thread: that of the host.
#pragma once

#include <cstddef>

#include <nlohmann/json_fwd.hpp>

#include "programs/godwit-sim/host/vehicle_host.hpp"

namespace godwit::sim {

inline constexpr std::size_t status_page = 100;

[[nodiscard]] nlohmann::json answer_control(vehicle_host& host, const nlohmann::json& request);

} // namespace godwit::sim
