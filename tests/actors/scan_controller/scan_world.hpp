// Points of interest without an actor: the facts of the core are applied as they come, in a time that the test moves.
// Thread: one.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "actors/scan_controller/core.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"

namespace godwit::test {

inline constexpr std::int64_t second = 1'000'000'000;
inline const std::string scan_mission = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

// The n-th thing, a hundred metres to the north of the one before.
[[nodiscard]] inline scan_controller::candidate thing(int number, double confidence = 0.9) {
  scan_controller::candidate result;
  result.id = sighting_id(number);
  result.mission_id = scan_mission;
  result.class_group = "vehicle";
  result.position = {47.39 + 0.0009 * number, 8.54, {}};
  result.confidence = confidence;
  return result;
}

struct scan_world {
  explicit scan_world(scan_controller::settings configured = {}) : core(std::move(configured)) {}

  [[nodiscard]] godwit::instant now() const { return {now_ns, wall_began_ns + now_ns}; }
  void apply(const scan_controller::fact& each) {
    for (auto& effect : scan_controller::durable_core::apply(state, each, now().wall_ns))
      effects.push_back(std::move(effect));
  }
  void turn() {
    while (const auto due = core.next_due(state, now()))
      apply(*due);
  }
  // All that becomes due on the way happens at its time.
  void wait(std::int64_t ns) {
    const auto end_ns = now_ns + ns;
    for (auto next_ns = core.next_deadline_ns(state); next_ns <= end_ns; next_ns = core.next_deadline_ns(state)) {
      now_ns = std::max(now_ns, next_ns);
      turn();
    }
    now_ns = end_ns;
  }
  // Seen now.
  scan_controller::candidate_answer see(scan_controller::candidate what) {
    what.at_ns = now().wall_ns;
    return see_as_dated(what);
  }
  scan_controller::candidate_answer see_as_dated(const scan_controller::candidate& what) {
    const auto judged = core.on_candidate(state, what, now());
    for (const auto& each : judged.facts)
      apply(each);
    turn();
    return judged.answer;
  }
  scan_controller::decide_answer say(std::uint64_t number, scan_controller::decision what,
                                     const std::string& by = "anna") {
    const auto decided = scan_controller::core::on_decision(state, {number, what, by}, now());
    if (decided.what)
      apply(*decided.what);
    turn();
    return decided.answer;
  }
  [[nodiscard]] std::vector<std::uint64_t> shown() const {
    std::vector<std::uint64_t> result;
    for (const auto& each : state.shown)
      result.push_back(each.what.number);
    return result;
  }

  static constexpr std::int64_t wall_began_ns = 1'800'000'000 * second;
  std::int64_t now_ns = 1'000 * second;
  scan_controller::state state;
  scan_controller::core core;
  std::vector<scan_controller::durable_core::effect> effects;
};

} // namespace godwit::test
