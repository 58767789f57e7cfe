// Commands that wait for their COMMAND_ACK, and whom each answer is for.
//
//   take ──> waiting ──ACK with a final result──> done
//              │  ^ └──deadline passed──────────> done (timed_out)
//              └──┘ ACK IN_PROGRESS: a new deadline, at most max_progress_ms after the start
//
// There is one command in flight for each (command id, component): the ack carries nothing else to tell two apart. What
// comes back without a command that waits for it (PX4 answers some twice) is counted and ignored. A command of more
// than one copy is due again while it waits, as command.hpp says; whether a copy still goes out is the caller's
// decision. Pure: time comes in as monotonic nanoseconds. Source: MAVLink command protocol.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/mavlink/messages/command.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::vehicle_link {

inline constexpr std::size_t max_commands_in_flight = 32;

// A vehicle that reports progress is waited for as long as this (a calibration takes minutes).
inline constexpr std::int64_t max_progress_ms = 600'000;

// Whose command it is: that of an actor which waits for the answer, or one of our own.
enum class asker_kind { outside, streams, current_item, look };
struct asker {
  asker_kind kind = asker_kind::outside;
  std::uint64_t request_id = 0; // of the actor's request
};

struct resolved_command {
  asker asked_by;
  command_outcome outcome;
};

class pending_commands {
public:
  // Why this command can not wait here, or nothing: then it does, and has to be sent now.
  [[nodiscard]] std::optional<command_verdict> take(asker asked_by, const send_command& what, std::int64_t timeout_ms,
                                                    std::int64_t now_ns);

  // An answer from COMPONENT of the vehicle. Nothing: it was of no final result, or nobody waits for it.
  [[nodiscard]] std::optional<resolved_command> acknowledge(const io::mavlink::command_ack& ack, std::uint8_t component,
                                                            std::int64_t now_ns);

  [[nodiscard]] std::vector<resolved_command> expire(std::int64_t now_ns);

  // Copies that are to be sent now, each with its `confirmation`.
  [[nodiscard]] std::vector<send_command> due_copies(std::int64_t now_ns);
  void send_no_more_copies(const send_command& of);
  void send_no_more_copies(); // of any

  // All that wait end like this, because the vehicle or the link has changed.
  [[nodiscard]] std::vector<resolved_command> end_all(command_verdict verdict, const std::string& reason);

  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const;
  [[nodiscard]] std::size_t in_flight() const { return waiting_.size(); }
  // It waits for its answer, or has until lately: an answer without an addressee may be a repetition of that one.
  [[nodiscard]] bool is_own(std::uint16_t command, std::int64_t now_ns) const;

  static constexpr std::int64_t own_answers_repeat_ns = 10'000'000'000;

private:
  struct waiting {
    asker asked_by;
    send_command what; // with copies left to send
    std::int64_t copy_ns = 0;
    std::int64_t sent_ns = 0;
    std::int64_t timeout_ns = 0;
    std::int64_t deadline_ns = 0;
  };
  using key = std::pair<std::uint16_t, std::uint8_t>; // command id, component

  [[nodiscard]] std::int64_t copy_after_ns() const; // on this line
  void stop_late_copies(waiting& entry) const;

  static constexpr std::size_t round_trips_kept = 4;
  std::vector<std::int64_t> round_trips_ns_; // of the newest answers
  std::map<key, waiting> waiting_;
  std::map<std::uint16_t, std::int64_t> own_; // command id, when it was sent last
};

// "the vehicle denied it", for a MAV_RESULT.
[[nodiscard]] std::string sentence_for_result(std::uint8_t result);

} // namespace godwit::vehicle_link
