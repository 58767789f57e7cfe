// What the executor wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/state.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/mission_client/types.hpp"
#include "messages/vehicle_link/types.hpp"

namespace godwit::executor {

// To the journal. What follows from it comes back as on_news.
struct note {
  durable_core::event what;
};

// When something goes out: after all that was noted so far, or at once. Only what stops the vehicle, brings it home or
// concerns who has it is sent while the disk does not write.
enum class goes { after_notes, at_once };

// To the vehicle, or (guard_mission) to the failsafe; its outcome comes back with the number. The modes that it makes
// expected are told to the failsafe with it. One that waits for the disk is let out by the core (core::lets_out), which
// may have changed its mind meanwhile.
struct order {
  goes when = goes::after_notes;
  std::uint64_t number = 0;
  std::int64_t decided_ns = 0;
  std::vector<std::uint32_t> expected; // the exact modes that obey it
  std::variant<vehicle_link::send_command, vehicle_link::set_current_item, vehicle_link::upload_plan,
               vehicle_link::download_plan, vehicle_link::look, failsafe::guard_mission>
      what;
};

// To the failsafe: whose the next mode is, that an operator has handed the vehicle back, and whether the return that it
// has asked for is flown.
struct send_to_failsafe {
  std::variant<failsafe::expect_mode, failsafe::hand_back, failsafe::taken_over, failsafe::command_pending,
               failsafe::return_taken>
      what;
};

// To ground_port.
struct send_to_port {
  std::variant<ground_port::set_mission, ground_port::mission_progress, ground_port::plan_judged, act_resolved> what;
};

// The transfer under way is given up.
struct give_up_transfer {};

// While a flight is started the vehicle is to tell its state more often.
struct watch_vehicle {
  bool is_close = false;
};

// To mission_client.
struct send_to_client {
  std::variant<mission_client::begin_mission, mission_client::begin_next, mission_client::pull_map,
               mission_client::accept_copy, mission_client::push_map>
      what;
};

// For people; a warning asks for one.
struct announce {
  std::string sentence;
  bool is_warning = false;
  bool is_vehicles = false; // its own words, which stations hear from it
};

using effect = std::variant<note, order, give_up_transfer, watch_vehicle, send_to_failsafe, send_to_client,
                            send_to_port, announce>;
using effects = std::vector<effect>;

} // namespace godwit::executor
