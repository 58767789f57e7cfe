// Makes one item of the vehicle's mission the current one, by the way that this vehicle knows.
//
//   idle ──begin──> commanded ──accepted──────────────> done
//                       │ └─────refused, timed out────> done
//                       └─unsupported──> announced ──MISSION_CURRENT says so──> done
//                                            │  └─each copy_after_ms: MISSION_SET_CURRENT, three in all
//                                            ├──announce_timeout_ms────> done (timed_out)
//                                            └──another mode before either send──> done (outdated)
//
// DO_SET_MISSION_CURRENT has an answer; PX4 does not know it (MAV_RESULT_UNSUPPORTED) and takes MISSION_SET_CURRENT,
// to which the answer is the broadcast MISSION_CURRENT, and a refusal is a status text only.
// Pure: time comes in as monotonic nanoseconds. Source: MAVLink mission protocol, "Set Current Mission Item".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "actors/vehicle_link/pending_commands.hpp"
#include "io/mavlink/enums.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

inline constexpr std::int64_t announce_timeout_ms = 2'500; // MISSION_CURRENT comes once a second

class current_setter {
public:
  [[nodiscard]] bool is_busy() const { return step_ != step::idle; }
  [[nodiscard]] std::uint64_t request_id() const { return request_id_; }
  [[nodiscard]] std::uint16_t sequence() const { return sequence_; }

  // The command to send first.
  [[nodiscard]] send_command begin(std::uint64_t request_id, const set_current_item& wanted) {
    step_ = step::commanded;
    request_id_ = request_id;
    sequence_ = wanted.sequence;
    only_while_ = wanted.only_while;
    send_command what;
    what.command = command;
    what.param1 = static_cast<float>(sequence_);
    what.copies = copies_of_moving_order;
    what.only_while = only_while_;
    return what;
  }
  [[nodiscard]] const std::optional<seen_state>& only_while() const { return only_while_; }

  // The vehicle is not as it was when it was decided.
  [[nodiscard]] command_outcome end_outdated(std::string reason) {
    return end({.command = command, .verdict = command_verdict::outdated, .reason = std::move(reason)});
  }

  // The end of that command. The outcome for the asker, or nothing: announce the sequence with MISSION_SET_CURRENT now.
  [[nodiscard]] std::optional<command_outcome> on_outcome(const command_outcome& outcome, std::int64_t now_ns) {
    const bool unknown_to_vehicle = outcome.verdict == command_verdict::refused &&
                                    outcome.result == static_cast<std::uint8_t>(io::mavlink::mav_result::unsupported);
    if (!unknown_to_vehicle)
      return end(outcome);
    step_ = step::announced;
    copies_left_ = copies_of_moving_order - 1;
    again_ns_ = now_ns + copy_after_ms * ns_per_ms;
    deadline_ns_ = now_ns + announce_timeout_ms * ns_per_ms;
    return std::nullopt;
  }

  [[nodiscard]] std::optional<command_outcome> on_mission_current(std::uint16_t sequence) {
    if (step_ != step::announced || sequence != sequence_)
      return std::nullopt;
    return end({.command = command, .verdict = command_verdict::accepted});
  }

  [[nodiscard]] std::optional<command_outcome> on_time(std::int64_t now_ns) {
    if (step_ != step::announced || now_ns < deadline_ns_)
      return std::nullopt;
    return end({.command = command,
                .verdict = command_verdict::timed_out,
                .reason = "the vehicle does not report item " + std::to_string(sequence_) +
                          " as its current one; its status text may say why"});
  }

  // True when a copy of MISSION_SET_CURRENT is to be sent.
  [[nodiscard]] bool wants_repetition(std::int64_t now_ns) {
    if (step_ != step::announced || copies_left_ == 0 || now_ns < again_ns_)
      return false;
    --copies_left_;
    again_ns_ = now_ns + copy_after_ms * ns_per_ms;
    return true;
  }

  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const {
    if (step_ != step::announced)
      return std::nullopt;
    return copies_left_ > 0 ? again_ns_ : deadline_ns_;
  }

private:
  enum class step { idle, commanded, announced };
  static constexpr auto command = static_cast<std::uint16_t>(io::mavlink::mav_cmd::do_set_mission_current);

  command_outcome end(command_outcome outcome) {
    step_ = step::idle;
    return outcome;
  }

  step step_ = step::idle;
  std::uint64_t request_id_ = 0;
  std::uint16_t sequence_ = 0;
  std::optional<seen_state> only_while_;
  std::uint8_t copies_left_ = 0;
  std::int64_t again_ns_ = 0;
  std::int64_t deadline_ns_ = 0;
};

} // namespace godwit::vehicle_link
