// How far a mission got, told truthfully: the part of the executor's decisions that turns what the vehicle says into
// progress reports.
//
//   auto effects = apply(state, current_told{message}, now_ns); // commit both, then let the effects out
//
// Pure: the same state, event and time give the same effects. The caller makes the new state durable together with the
// effects before it lets them out, so that a crash in between loses and doubles nothing. Thread: one at a time.
//
// Rules, each with a test of its own name: a report has the number after the one before, in each mission; no report is
// of a generation before the newest; within a generation the index of the items never goes back; `complete` comes once
// for each revision; nothing counts in a generation that is not armed, and nothing while paused.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "actors/executor/progress/effects.hpp"
#include "actors/executor/progress/events.hpp"
#include "actors/executor/progress/state.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::executor::progress {

[[nodiscard]] effects apply(state& s, const event& happened, std::int64_t now_ns);

// What a new incarnation has to look at before anything else. May be asked for more than once.
[[nodiscard]] effects resume(const state& s);

// False: handling it would change nothing, so that it need not be written down. A vehicle says most things many times.
// Takes as long as a copy of the state.
[[nodiscard]] bool matters(const state& s, const event& happened, std::int64_t now_ns);

// The last item that moves the vehicle is the one where it is, or was when it was heard last, and is not done.
[[nodiscard]] bool is_at_last_movement(const state& s);

// Before its end, as its last report tells.
[[nodiscard]] inline bool was_called_off(const mission_record& mission) {
  return mission.last_report && mission.last_report->kind == mission::progress_kind::aborted;
}

// This mission was flown to its end, or was called off, in this revision or a later one: now, or before another was
// opened (of the last max_past_missions).
[[nodiscard]] bool has_ended(const state& s, std::string_view mission_id, std::int32_t revision);

// Of this mission something was told, now or before another was opened, and neither its end nor that it was called off:
// some flight is in the middle of it.
[[nodiscard]] bool is_begun(const state& s, std::string_view mission_id);

// Of the open mission.
[[nodiscard]] std::optional<mission::progress_report> last_progress(const state& s);

} // namespace godwit::executor::progress
