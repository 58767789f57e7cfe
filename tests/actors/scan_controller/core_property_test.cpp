// A million random arrivals, decisions and crashes: never more than five points in any 60 s, each point above the
// threshold is shown or dropped with a reason, and what was decided stays.
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <random>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "tests/actors/scan_controller/scan_world.hpp"
#include "tests/support/run_options.hpp"

namespace scan_controller_core_property_test {

using namespace godwit;
using namespace godwit::scan_controller;
using namespace godwit::test;
using scan_controller::state;

constexpr double threshold = 0.4;

// What came out, seen from outside; nothing here depends on the core.
class judge {
public:
  void look(const durable_core::effect& each, const std::string& mission, std::int64_t now_ns) {
    if (const auto* shown = std::get_if<point_shown>(&each)) {
      EXPECT_TRUE(shown_.emplace(shown->number, now_ns).second) << "shown twice: " << shown->number;
      EXPECT_GE(shown->confidence, threshold);
      last_.push_back(now_ns);
      while (now_ns - last_.front() > rate_window_ns)
        last_.pop_front();
      EXPECT_LE(last_.size(), 5U);
      return;
    }
    const auto& closed = std::get<point_closed>(each);
    EXPECT_TRUE(outcomes_.emplace(closed.number, closed.outcome).second) << "closed twice: " << closed.number;
    ASSERT_TRUE(shown_.contains(closed.number));
    const auto open_ns = now_ns - shown_.at(closed.number);
    const bool was_in_time = open_ns < 60 * second;
    if (closed.mission_id == mission) { // else it is over
      EXPECT_EQ(was_in_time, closed.outcome != point_outcome::passed_over) << open_ns;
    }
  }
  [[nodiscard]] std::uint64_t shown() const { return shown_.size(); }
  [[nodiscard]] std::uint64_t closed() const { return outcomes_.size(); }
  [[nodiscard]] std::optional<point_outcome> outcome_of(std::uint64_t number) const {
    const auto found = outcomes_.find(number);
    return found == outcomes_.end() ? std::nullopt : std::optional(found->second);
  }

private:
  std::map<std::uint64_t, std::int64_t> shown_;
  std::deque<std::int64_t> last_;
  std::map<std::uint64_t, point_outcome> outcomes_;
};

class random_scan {
public:
  explicit random_scan(std::uint64_t seed) : rng_(seed) {}

  void run(int arrivals) {
    for (int i = 0; i < arrivals && !testing::Test::HasFailure(); ++i) {
      pass_time();
      arrive(i);
      if (draw(8) == 0)
        decide();
      if (i % 1'000 == 0)
        reread();
    }
    wait(700 * second);
  }

  void look_at_end() {
    const auto& c = world_.state.counts;
    EXPECT_TRUE(world_.state.waiting.empty());
    EXPECT_TRUE(world_.state.shown.empty());
    EXPECT_EQ(c.confirmed + c.declined + c.passed_over, judge_.shown()) << "each that was shown has ended in one way";
    EXPECT_EQ(judge_.closed(), judge_.shown());
    EXPECT_EQ(c.opened, judge_.shown() + c.too_faint + c.too_old + c.no_room + c.mission_over);
  }

private:
  std::uint64_t draw(std::uint64_t below) { return rng_() % below; }

  // A crash forgets what a step has decided; the input comes again. What was applied stays.
  bool crashes() { return draw(3) == 0; }

  void apply(const std::vector<fact>& facts) {
    for (const auto& each : facts)
      world_.apply(each);
    for (const auto& each : std::exchange(world_.effects, {}))
      judge_.look(each, mission_, world_.now_ns);
  }

  void turn() {
    while (const auto due = world_.core.next_due(world_.state, world_.now()))
      if (!crashes())
        apply({*due});
  }

  void wait(std::int64_t ns) {
    const auto end_ns = world_.now_ns + ns;
    for (auto next_ns = world_.core.next_deadline_ns(world_.state); next_ns <= end_ns;
         next_ns = world_.core.next_deadline_ns(world_.state)) {
      world_.now_ns = std::max(world_.now_ns, next_ns);
      turn();
    }
    world_.now_ns = end_ns;
  }

  // Bursts, and lulls of minutes. Sometimes the process was away and everything is late.
  void pass_time() {
    const auto kind = draw(100);
    if (kind == 0)
      world_.now_ns += static_cast<std::int64_t>(draw(200) * second);
    else
      wait(static_cast<std::int64_t>(kind < 60 ? draw(second / 10) : draw(10 * second)));
  }

  void arrive(int i) {
    auto what = thing(static_cast<int>(draw(400)), 0.01 * static_cast<double>(draw(101)));
    what.id = sighting_id(i);
    what.class_group = draw(2) == 0 ? "vehicle" : "person";
    what.has_moved = draw(4) == 0;
    what.is_known = draw(8) == 0;
    what.at_ns = world_.now().wall_ns - static_cast<std::int64_t>(draw(50) == 0 ? draw(700) * second : draw(second));
    if (draw(5'000) == 0)
      mission_ = sighting_id(1'000'000 + i);
    what.mission_id = mission_;
    turn();
    auto judged = world_.core.on_candidate(world_.state, what, world_.now());
    while (crashes())
      judged = world_.core.on_candidate(world_.state, what, world_.now());
    apply(judged.facts);
    turn();
    if (draw(10) == 0) { // the answer was lost, and it is said again
      EXPECT_NE(world_.core.on_candidate(world_.state, what, world_.now()).answer.fate, candidate_fate::opened);
    }
  }

  void decide() {
    turn();
    const auto number = world_.state.last_number - std::min(draw(6), world_.state.last_number);
    const auto says = draw(2) == 0 ? decision::confirm : decision::decline;
    const auto before = judge_.outcome_of(number);
    const auto decided = core::on_decision(world_.state, {number, says, "anna"}, world_.now());
    if (decided.what && !crashes())
      apply({*decided.what});
    const auto wanted = says == decision::confirm ? point_outcome::confirmed : point_outcome::declined;
    if (before && decided.answer.is_taken) {
      EXPECT_EQ(*before, wanted) << "what was decided stays";
    }
    world_.state.owed.clear(); // the map takes them
    turn();
  }

  // The stored form is all that there is.
  void reread() {
    state read;
    ASSERT_TRUE(io::read_json(nlohmann::json::parse(io::to_json(world_.state)), read));
    ASSERT_TRUE(io::equal(read, world_.state));
    world_.state = read;
  }

  std::mt19937_64 rng_;
  scan_world world_{{.min_confidence = threshold}};
  judge judge_;
  std::string mission_ = scan_mission;
};

TEST(scan_property, a_million_arrivals_with_crashes_never_show_more_than_five_in_a_minute_and_lose_no_point) {
  const auto seeds = godwit::tests::is_full_run() ? 10U : 1U;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_scan scan(seed);
    scan.run(1'000'000);
    scan.look_at_end();
    if (HasFailure())
      return;
  }
}

} // namespace scan_controller_core_property_test
