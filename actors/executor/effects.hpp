// What the executor wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/state.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/mission_client/types.hpp"
#include "messages/vehicle_link/types.hpp"

namespace godwit::executor {

// To the journal. What follows from it comes back as on_durable.
struct note {
  durable_core::event what;
};

// To the vehicle, or (guard_mission) to the failsafe; its outcome comes back with the number.
struct order {
  std::uint64_t number = 0;
  std::variant<vehicle_link::send_command, vehicle_link::set_current_item, vehicle_link::upload_plan,
               vehicle_link::download_plan, failsafe::guard_mission>
      what;
};

// To the failsafe: whose the next mode is, and that an operator has handed the vehicle back.
struct say_to_failsafe {
  std::variant<failsafe::expect_mode, failsafe::hand_back, failsafe::taken_over> what;
};

// To ground_port.
struct say_to_port {
  std::variant<ground_port::set_mission, ground_port::mission_progress> what;
};

// The transfer under way is given up.
struct give_up_transfer {};

// To mission_client.
struct say_to_client {
  std::variant<mission_client::begin_mission, mission_client::pull_map, mission_client::push_map> what;
};

// For people; a warning asks for one.
struct announce {
  std::string sentence;
  bool is_warning = false;
};

using effect = std::variant<note, order, give_up_transfer, say_to_failsafe, say_to_client, say_to_port, announce>;
using effects = std::vector<effect>;

} // namespace godwit::executor
