// MISSION_START that was given to the executor: whose it is, when it is over, and what a repetition hears.
//
//   (none) ──begin()──> asked ──answer, or silence for answer_patience──> resolved ──begin()──> asked ...
//
// One at a time. A repetition is the same order from the same station for the same plan: with a confirmation above 0 as
// long as the answer is remembered, or once more with 0 shortly after (MAVSDK repeats so), unless it was refused: then
// it is a second request. A repetition is never given to the executor again: while it is asked the station hears
// IN_PROGRESS, then the answer that there was. An answer after the patience was used up corrects what was told. Pure;
// survives a crash as a start_record. Thread: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "actors/ground_port/state.hpp"
#include "actors/ground_port/vehicle_role/mission_start.hpp"
#include "actors/ground_port/vehicle_role/order.hpp"
#include "io/mavlink/signing/channel.hpp"

namespace godwit::ground_port {

class start_dedup {
public:
  // Begun later than this it is not obeyed: who asked has gone on to something else.
  static constexpr std::int64_t obeyed_within_ns = 3'000'000'000;
  // Longer than what a start takes: modes, arming and the start itself, each tried again a few times. Until then
  // repetitions hear IN_PROGRESS.
  static constexpr std::int64_t answer_patience_ns = 20'000'000'000;
  // A station that counts its repetitions means the same order for as long.
  static constexpr std::int64_t remembered_ns = 10'000'000'000;
  // MAVSDK sends up to 4 times at 0.5 s; whoever presses the button again is slower.
  static constexpr std::int64_t repeats_uncounted_ns = 2'000'000'000;

  enum class kind { fresh, repeated_while_asked, repeated_after, busy };

  start_dedup(std::optional<start_record> restored, io::mavlink::instant now);

  // PLAN_ID: of the mission that is held now.
  [[nodiscard]] kind judge(const vehicle_role::order& what, std::uint32_t plan_id, io::mavlink::instant now) const;

  // Only when `fresh`. The record to make durable; the executor is asked when it is.
  [[nodiscard]] start_record begin(const vehicle_role::order& what, const vehicle_role::start_decision& decided,
                                   std::uint32_t plan_id, io::mavlink::instant now);
  // The executor's answer. The record to make durable; nothing: nobody waits for this answer.
  [[nodiscard]] std::optional<start_record> resolve(const executor::start_answer& answer, io::mavlink::instant now);
  // The executor was silent for too long.
  [[nodiscard]] std::optional<start_record> on_time(io::mavlink::instant now);

  [[nodiscard]] bool is_asked() const { return record_ && !record_->is_resolved; }
  [[nodiscard]] const std::optional<start_record>& record() const { return record_; }
  [[nodiscard]] std::int64_t next_deadline_ns() const {
    return is_asked() ? deadline_ns_ : std::numeric_limits<std::int64_t>::max();
  }

private:
  [[nodiscard]] start_record resolved(io::mavlink::mav_result result, std::string text, bool is_answered,
                                      io::mavlink::instant now);

  std::optional<start_record> record_;
  std::int64_t deadline_ns_ = 0; // monotonic, while asked
  std::int64_t resolved_ns_ = 0; // monotonic
};

} // namespace godwit::ground_port
