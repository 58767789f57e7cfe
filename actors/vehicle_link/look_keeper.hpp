// Looks at the vehicle for whoever is about to move it: asks for a HEARTBEAT, and knows when one has come that was sent
// after it was asked for.
//
//   idle ──begin──> asked ──ACCEPTED──> awaited ──HEARTBEAT──> seen
//                    │ ^                  PX4 sends the heartbeat before its answer: one since it was asked is that one
//                    │ └──ask_again_ms: no answer (a request moves nothing, and may be repeated)
//                    ├──refused (an older vehicle): its next periodic HEARTBEAT counts
//                    ├──handled later than comes_within_ms: asked again
//                    └──gives_up_ms──────────────────────────────> not seen
//
// A process that was stopped finds in its socket what was sent before: an answer or a heartbeat that is handled so late
// says nothing of now.
//
// Pure: time comes in as monotonic nanoseconds. Source: MAV_CMD_REQUEST_MESSAGE (512); the order of answer and message
// as ArduPilot 4.7 and PX4 1.18 were seen to have it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "actors/vehicle_link/effects.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/time_units.hpp"
#include "messages/vehicle_link/evidence.hpp"

namespace godwit::vehicle_link {

class look_keeper {
public:
  static constexpr std::int64_t ask_again_ms = 300;      // above the round trip of most radios
  static constexpr std::int64_t retry_ms = 50;           // while another message is being requested
  static constexpr std::int64_t comes_within_ms = 1'200; // after the request, or after its answer: one heartbeat
  static constexpr std::int64_t gives_up_ms = 3'000;     // three heartbeats of a vehicle that knows no request

  // The one that waited before, which is not answered otherwise.
  [[nodiscard]] std::optional<resolved_look> begin(std::uint64_t request_id, bool answers_after_message,
                                                   std::int64_t now_ns) {
    auto before = end(false, 0, "another observation was begun");
    request_id_ = request_id;
    answers_after_message_ = answers_after_message;
    is_heard_ = is_accepted_ = false;
    due_ns_ = now_ns;
    gives_up_ns_ = now_ns + gives_up_ms * ns_per_ms;
    return before;
  }

  // The request that is to be sent now.
  [[nodiscard]] std::optional<send_command> next_request(std::int64_t now_ns) {
    if (!request_id_ || !due_ns_ || now_ns < *due_ns_)
      return std::nullopt;
    due_ns_.reset();
    is_heard_ = false;
    since_ns_ = now_ns;
    send_command what;
    what.command = io::mavlink::number(io::mavlink::mav_cmd::request_message);
    what.param1 = static_cast<float>(io::mavlink::heartbeat::message_id);
    what.timeout_ms = ask_again_ms;
    return what;
  }

  [[nodiscard]] std::optional<resolved_look> on_heartbeat(std::int64_t now_ns) {
    if (!request_id_)
      return std::nullopt;
    is_heard_ = is_heard_ || !due_ns_;
    if (!is_accepted_ || is_too_late(now_ns))
      return std::nullopt;
    return end(true, now_ns, {});
  }

  [[nodiscard]] std::optional<resolved_look> on_outcome(const command_outcome& outcome, std::int64_t now_ns) {
    if (!request_id_)
      return std::nullopt;
    const bool is_answer = outcome.verdict == command_verdict::accepted || outcome.verdict == command_verdict::refused;
    if (is_answer && is_too_late(now_ns))
      return std::nullopt;
    since_ns_ = now_ns;
    switch (outcome.verdict) {
    case command_verdict::accepted:
      if (is_heard_ && answers_after_message_)
        return end(true, now_ns, {});
      [[fallthrough]];
    case command_verdict::refused:
      is_accepted_ = true;
      return std::nullopt;
    case command_verdict::timed_out:
      due_ns_ = now_ns;
      return std::nullopt;
    default:
      due_ns_ = now_ns + retry_ms * ns_per_ms;
      return std::nullopt;
    }
  }

  [[nodiscard]] std::optional<resolved_look> on_time(std::int64_t now_ns) {
    if (!request_id_ || now_ns < gives_up_ns_)
      return std::nullopt;
    return end(false, 0, "the vehicle sends no heartbeat when it is asked for one");
  }

  // Nobody hears the vehicle any more.
  [[nodiscard]] std::optional<resolved_look> give_up(std::string why) { return end(false, 0, std::move(why)); }

  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const {
    if (!request_id_)
      return std::nullopt;
    return due_ns_ ? std::min(*due_ns_, gives_up_ns_) : gives_up_ns_;
  }

private:
  // True: it is asked for again.
  [[nodiscard]] bool is_too_late(std::int64_t now_ns) {
    if (now_ns - since_ns_ <= comes_within_ms * ns_per_ms)
      return false;
    is_accepted_ = is_heard_ = false;
    due_ns_ = now_ns;
    return true;
  }

  [[nodiscard]] std::optional<resolved_look> end(bool is_seen, std::int64_t at_ns, std::string reason) {
    if (!request_id_)
      return std::nullopt;
    return resolved_look{*std::exchange(request_id_, std::nullopt), {is_seen, at_ns, std::move(reason)}};
  }

  std::optional<std::uint64_t> request_id_; // who waits
  bool answers_after_message_ = false;
  bool is_heard_ = false;              // a heartbeat, since it was asked for last
  bool is_accepted_ = false;           // the next heartbeat is the one
  std::optional<std::int64_t> due_ns_; // the next request; none: one is under way, or answered
  std::int64_t since_ns_ = 0;          // the request, or its answer
  std::int64_t gives_up_ns_ = 0;
};

} // namespace godwit::vehicle_link
