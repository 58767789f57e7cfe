// Whether an order may go to the vehicle now: the one function that every order of a task passes, when it is decided
// and again when the disk has written what it waits for.
//
//   order     goes out when
//   stops     always: hold, return, disarm on the ground
//   neutral   godwit has the vehicle: a plan, home, a mode in which nothing begins
//   holds     the same, and it was looked at for this very order: what moves it afterwards goes out by itself
//   moves     godwit has the vehicle, it was looked at for this very order, and its plan is proved where it flies one
//
// The limits are those of docs/decisions/authority.md. Pure. Thread: any.
#pragma once

#include <cstdint>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/executor/evidence.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::executor {

enum class order_kind { stops, neutral, holds, moves };

// From the end of a proof to the order that flies the plan.
inline constexpr std::int64_t proof_counts_ns = 2'000'000'000;

struct intended_order {
  order_kind kind = order_kind::neutral;
  bool flies_plan = false;
  bool is_by_itself = false;      // it goes on from a hold without a command of an operator
  std::int64_t looked_ns = 0;     // for this order: when the heartbeat came; 0: not yet
  std::int64_t proof_from_ns = 0; // a proof of this age or younger counts
};

enum class permission {
  may,
  prove,     // first that the vehicle holds our plan
  look,      // first at the vehicle
  wait,      // it is unclear who has it
  uncertain, // whose hold it is will not be known
  not_ours   // somebody else has it
};

[[nodiscard]] permission may_send(const intended_order& order, const flight::control_authority& authority,
                                  const evidence& seen, std::int64_t now_ns);

} // namespace godwit::executor
