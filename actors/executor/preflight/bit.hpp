// Whether this flight may start, by what the preflight checks find (BIT: built-in test).
//
//             checks_wanted              look: nothing fails or degrades, or all that
//      idle ───────────────> running ─── degrades is acknowledged ─────────────────────> pass
//        ^                      │ │                                                      ^  │
//        │                      │ └ look: something degrades ──> awaiting_ack ──ack──────┘  │ look: worse
//        │                      │                                  │ 5 min   ^              │ (before the take-off)
//        │  mission changed,    │ look: something fails            v         │ look: better v
//        └─ flight ended        └───────────────────────────────> failed ────┴─> pass, awaiting_ack or failed
//
// A pass is for this flight: it is gone when the flight has ended, or the mission or its revision has changed. While
// nothing has taken off each look decides anew. What operators acknowledge is a numbered report: a new sentence makes a
// new report, and fewer sentences, or the same once more, do not, so that there is time to read and name it. After a
// failure there is always a new report. One that nobody acknowledged in time is not opened again by itself, unless
// something in it became better; checks_wanted asks for a new look.
//
// After a restart a look comes before anything counts as passed. In the air nothing is checked: who is there without a
// pass is idle. Time is the wall clock; one that was set back ends the wait for an acknowledgement.
//
//   auto news = apply(state, looked{run_checks(facts, settings)}, now_ns); // commit the state, then tell the news
//
// Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "actors/executor/preflight/bit_announcements.hpp"
#include "actors/executor/preflight/bit_events.hpp"
#include "actors/executor/preflight/bit_state.hpp"

namespace godwit::executor::preflight {

// Enough to read some sentences and walk to the vehicle; who comes later should look again.
inline constexpr std::int64_t acknowledge_within_ns = 300'000'000'000;

[[nodiscard]] announcements apply(state& s, const event& happened, std::int64_t now_ns);

// False: handling it would change nothing, so that it need not be written down. Most looks find what the one before
// did.
[[nodiscard]] bool matters(const state& s, const event& happened, std::int64_t now_ns);

// Whether this mission in this revision has passed by the looks that were handled. What may have changed since then is
// asked with why_not_start.
[[nodiscard]] bool is_passed(const state& s, std::string_view mission_id, std::int32_t revision);

// Just before a start: why the flight may not start by a look of this moment, which need not be handled yet; empty: it
// may. Nothing starts on what was found a second ago.
[[nodiscard]] std::string why_not_start(const state& s, const report& seen, std::int64_t now_ns);

// How it stands, and what has to be done.
[[nodiscard]] std::string sentence_of(const state& s);

} // namespace godwit::executor::preflight
