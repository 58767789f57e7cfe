// Asks for assignments, one long poll after the other, while a mission is loaded.
//
// What has been told to the one who flies is not asked for again until it is resolved; after a rejection the service
// makes a new assignment, which has a higher revision. Thread: one at a time.
#pragma once

#include "actors/mission_client/planning_context.hpp"

namespace godwit::mission_client {

// A service that answers at once with nothing new, against the contract, is not asked more often than this.
inline constexpr std::int64_t least_poll_period_ns = second_ns;

class polling final : public blockable_part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;

private:
  attempt attempt_;
  std::string mission_id_;
  std::int64_t started_ns_ = 0;
};

} // namespace godwit::mission_client
