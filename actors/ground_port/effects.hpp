// What the core of ground_port wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/ground_port/state.hpp"
#include "actors/line/transmission.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/frame.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/executor/types.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/operator/types.hpp"
#include "messages/vehicle_link/evidence.hpp"

namespace godwit::ground_port {

using line::transmission;

// The executor is asked; its answer comes back with the request's number.
struct start_request_to_executor {
  std::uint64_t request = 0;
  executor::set_current what;
};

// The same of an operator's word.
struct word_to_say {
  std::uint64_t request = 0;
  operators::command what;
};

// To the vehicle.
struct pass_on {
  vehicle_link::relayed_frame what;
};

// The executor is asked whether it may be passed on.
struct act_to_ask {
  std::uint64_t request = 0;
  executor::station_act what;
};

// The executor is told what the vehicle has answered to a command that was passed on.
struct acknowledgement_to_tell {
  executor::act_acknowledged what;
};

// The failsafe is told that a person has the vehicle, by nobody else: the executor does not answer.
struct tell_taken_over {};

// operator_bridge writes it down: what WHO wanted of godwit, and what came of it.
struct audit_row_to_tell {
  io::mavlink::sender who;
  std::string what;
  std::string outcome;
  std::string reason;
};

// To be made durable. What comes of it is given to on_durable.
using durable_event = durable_core::event;

using effect = std::variant<transmission, start_request_to_executor, word_to_say, pass_on, act_to_ask,
                            acknowledgement_to_tell, tell_taken_over, audit_row_to_tell, durable_event, operator_link>;
using effects = std::vector<effect>;

} // namespace godwit::ground_port
