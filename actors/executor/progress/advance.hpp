// How an armed generation goes on: items are started, done, skipped; the plan is done; the mission is complete.
//
//   vehicle says                      item left        report
//   REACHED(s)                        s                reached
//   CURRENT(s + 1), REACHED(s)        s                reached, at REACHED
//   CURRENT(s + 1), and no REACHED    s                reached, inferred, after reached_late_ns
//   CURRENT(s + 3)                    s .. s + 2       reached, inferred, the same way
//   CURRENT(where a jump leads back)  up to the jump   reached; then a new generation from the target on
//   state complete, and no REACHED    all up to there  reached, inferred, the same way
//
// Items are resolved in the order of the mission, each once in a generation, so an index never goes back. What waits
// for a REACHED is resolved by the next message after its time, and at the latest when the generation ends. Thread:
// one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/executor/progress/decision_context.hpp"

namespace godwit::executor::progress {

// The vehicle is seen at SEQUENCE, ahead of where it was.
void move_on(decision_context& t, std::uint16_t sequence);

// The jump of LOOP has led it back to SEQUENCE: what stands before the jump is done, and a new generation begins in
// which the items of the loop are reported again.
void go_round(decision_context& t, const plan_loop& loop, std::uint16_t sequence);

// It is heard at SEQUENCE. Where that comes after a gap in which it may have flown a round, how many rounds it has
// flown is not certain any more.
void note_heard(decision_context& t, std::uint16_t sequence);

// It has reached SEQUENCE: the one where it is, or one that it has just left.
void arrive(decision_context& t, std::uint16_t sequence);

// What is awaited of what it has left may have come by now.
[[nodiscard]] bool has_waited(const decision_context& t);

// What it has moved on to is adopted when nothing is awaited any more of what it has left.
void go_on_if_known(decision_context& t);

// It says at SEQUENCE that the mission is complete.
void note_complete(decision_context& t, std::uint16_t sequence);

// With all items done up to the last one that moves the vehicle the plan is, and the mission where nothing follows. Not
// of one that ends in a loop: there a vehicle reports it.
void finish_if_done(decision_context& t, bool is_inferred);

// Settles what waits for a REACHED without it.
void catch_up(decision_context& t);

// The item where the vehicle is has started, if the vehicle flies it.
void begin(decision_context& t);

// A new generation of the plan that is there, numbered next, from START on. Items in front of it that no generation of
// this plan has resolved are skipped, and so are those that the plan leaves out.
void open_generation(decision_context& t, generation_origin origin, std::uint16_t start,
                     const std::vector<mapped_item>& left_out = {});

} // namespace godwit::executor::progress
