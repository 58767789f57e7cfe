// Asks which mission the vehicle is to fly next, one long poll after the other, while none is known.
//
// A bad answer is a sentence for people, and the same is asked again in growing pauses, about twice a minute at last:
// an unknown vehicle, another vehicle's mission, one that is over on board, what is no answer of the contract. Where it
// is not allowed, a person has to act. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>

#include "actors/mission_client/planning_context.hpp"

namespace godwit::mission_client {

class asking_next final : public blockable_part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;

private:
  attempt attempt_;
  std::int64_t started_ns_ = 0;
};

} // namespace godwit::mission_client
