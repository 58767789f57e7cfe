// What an ArduPilot forgets of its plan when it leaves its mission mode: after a pause its speed, region of interest
// and gimbal are commanded again.
//
//   paused ──flies on──> owed (durable) ──in its mission mode, godwit has it──> each in turn ──> nothing is owed
//
// The commands move nothing by themselves. One that is lost is sent max_tries times; one that is refused is reported,
// and the next comes. A crash in between sends all of them once more: they say what the plan says. The end of the
// flight ends what is owed. PX4 commands these by itself as it goes on. Pure. Thread: one at a time. Source:
// ArduCopter 4.7 (mode_auto.cpp, init and exit), seen in flight; PX4's MissionBase::replayCachedGimbalCameraModeItems.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "actors/executor/flight/flight_context.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::executor {

inline constexpr std::uint64_t first_of_lost_state = 1ULL << 37U;

class lost_state {
public:
  static constexpr int max_tries = 3;
  static constexpr std::int64_t answered_within_ns = 3'000'000'000; // longer than vehicle_link waits

  explicit lost_state(flight_context& flight) : flight_(flight) {}

  void look(effects& out, instant now);
  void on_command(effects& out, std::uint64_t number, const vehicle_link::command_outcome& outcome);

private:
  [[nodiscard]] bool may_set(instant now) const;
  void warn(effects& out, const std::string& why) const;

  flight_context& flight_;
  bool is_begun_ = false;
  std::vector<io::mavlink::mission_item_int> rest_; // the next one first
  int tries_ = 0;                                   // of that one
  std::int64_t asked_ns_ = 0;                       // 0: it waits for no answer
  std::uint64_t last_number_ = first_of_lost_state;
};

} // namespace godwit::executor
