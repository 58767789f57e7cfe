// Words of operators that were given to the executor: which station waits for an answer, and what a repetition hears.
//
//   (none) ──begin()──> asked ──resolve()──> resolved, remembered for remembered_ns ──> forgotten
//
// One word of each station is under way, and its last one is remembered. A repetition is the same command with the same
// parameters, to the bit, from the same station; the confirmation of COMMAND_LONG may differ. While the executor is
// asked it hears IN_PROGRESS, then the answer that there was. Not kept across a crash: the station then repeats the
// word, and it does no harm to be asked twice; at worst the second one is refused, because it is done. Whoever asks the
// executor sees to it that each command is resolved, by its answer or by its silence. Pure. Times: ns, monotonic.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "actors/ground_port/state.hpp"
#include "actors/ground_port/station_table.hpp"
#include "actors/ground_port/vehicle_role/mission_start.hpp"
#include "actors/ground_port/vehicle_role/order.hpp"
#include "io/mavlink/signing/channel.hpp"

namespace godwit::ground_port {

class command_dedup {
public:
  // As many as are known at all.
  static constexpr std::size_t max_stations = station_table::max_stations;
  // MAVSDK sends up to 4 times at 0.5 s; whoever says the same again after that means it.
  static constexpr std::int64_t remembered_ns = 3'000'000'000;

  // WHAT repeats the last command of its station: what the station hears. Nothing: it is no repetition.
  [[nodiscard]] std::optional<mavlink::mav_result> heard_before(const vehicle_role::order& what,
                                                                std::int64_t now_ns) const;
  // No word of FROM is under way, and there is room for one.
  [[nodiscard]] bool may_begin(mavlink::sender from, std::int64_t now_ns) const;

  // Only when it may, and WHAT is no repetition. The number of the request to the executor.
  [[nodiscard]] std::uint64_t begin(const vehicle_role::order& what, std::int64_t now_ns);
  // The order that is answered with this; nothing: nobody waits for it.
  [[nodiscard]] std::optional<vehicle_role::order> resolve(std::uint64_t request, mavlink::mav_result result,
                                                           std::int64_t now_ns);

private:
  struct entry {
    vehicle_role::order what;
    std::uint64_t request = 0;
    std::optional<mavlink::mav_result> result = {}; // none: asked
    std::int64_t resolved_ns = 0;
  };
  [[nodiscard]] static bool is_forgotten(const entry& each, std::int64_t now_ns);
  [[nodiscard]] const entry* last_of(mavlink::sender from) const;

  std::vector<entry> entries_; // one for each station
  std::uint64_t last_request_ = 0;
};

// MISSION_START that was given to the executor: whose it is, when it is over, and what a repetition hears.
//
//   (none) ──begin()──> asked ──answer, or silence for answer_patience──> resolved ──begin()──> asked ...
//
// One at a time. A repetition is the same order from the same station for the same plan: with a confirmation above 0 as
// long as the answer is remembered, or once more with 0 shortly after (MAVSDK repeats so), unless it was refused: then
// it is a second request. A repetition is never given to the executor again: while it is asked the station hears
// IN_PROGRESS, then the answer that there was. An answer after the patience was used up corrects what was told. Pure;
// survives a crash as a start_record. Thread: one at a time.
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
