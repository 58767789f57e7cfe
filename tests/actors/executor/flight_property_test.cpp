// Any order of crashes, pilots, pauses, replans and reboots, on every vehicle: what must hold whatever happens.
#include <array>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace flight_property_test {

using mission::progress_kind;
using tests::flight_world;

enum class trouble { crash, pilot, pause, assignment, reboot, refusal, crash_of_failsafe, kill, silence, change };
constexpr int kinds_of_trouble = 10;
constexpr int most_troubles = 6;

using tests::pilot_mode;

class random_flight {
public:
  explicit random_flight(std::uint64_t seed)
      : test_rng_(seed), who_(static_cast<sim::personality>(test_rng_() % 4)), mission_(tests::short_mission(who_)),
        is_map_late_(test_rng_() % 4 == 0), world_(any_world(test_rng_, who_, is_map_late_)) {}

  void fly() {
    world_.load(mission_);
    pull_map();
    const auto troubles = test_rng_() % (most_troubles + 1);
    for (std::size_t i = 0; i < troubles && !is_over(); ++i) {
      world_.run_for(0.05 * static_cast<double>(test_rng_() % 200));
      make(static_cast<trouble>(test_rng_() % kinds_of_trouble));
      judge();
    }
    for (int i = 0; i < 60 && !is_over() && !has_no_way_on(); ++i) {
      (void)world_.run_until(
          [&] { return is_over() || is_waiting_for_person() || !world_.durable().set_aside.empty(); }, 30);
      world_.set_changes(mission_client::change_verdict::done);
      judge();
      help();
    }
    judge();
    if (is_over())
      judge_items();
  }

  [[nodiscard]] std::string story() const { return did_ + world_.story(); }
  [[nodiscard]] bool is_over() const {
    const auto at = world_.durable().status.now;
    return at == phase::done || at == phase::aborted;
  }
  [[nodiscard]] bool was_disturbed_for_good() const { return rebooted_ || has_no_way_on(); }
  // The rest of a plane's mission can not be flown from the ground without its take-off, nor its landing alone from
  // anywhere; godwit says so.
  [[nodiscard]] bool has_no_way_on() const {
    const auto said = story();
    return who_ == sim::personality::plane &&
           (said.find("The mission can not be flown by this vehicle") != std::string::npos ||
            said.find("comes down to its landing from a place") != std::string::npos);
  }

private:
  // The map of some missions comes late; nothing is started meanwhile.
  void pull_map() {
    if (!is_map_late_)
      return;
    world_.run_for(static_cast<double>(test_rng_() % 10));
    EXPECT_EQ(starts_so_far(), 0) << "nothing is started without the map\n" << story();
    world_.pull_map(mission_client::pull_state::synced);
  }

  [[nodiscard]] bool is_waiting_for_person() const {
    const auto& durable = world_.durable();
    return durable.status.now == phase::paused || (durable.status.now == phase::ready && durable.awaits_word);
  }

  // Half of the lines lose, double and reorder frames.
  static flight_world::options any_world(std::mt19937_64& test_rng, sim::personality who, bool is_map_late) {
    flight_world::options result{.who = who, .start = start_policy::automatic, .arm_on_start = true, .speed = 10};
    result.seed = test_rng();
    if (is_map_late)
      result.map = mission_client::pull_state::in_flight;
    if (test_rng() % 2 == 0)
      return result;
    result.lost = 0.01 * static_cast<double>(test_rng() % 11);
    result.doubled = 0.01 * static_cast<double>(test_rng() % 11);
    result.most_delay_ms = 1 + static_cast<std::int64_t>(test_rng() % 90); // its clock is ten times as fast: just below
                                                                           // what would be a restart
    return result;
  }

  // Dies and comes back; nothing starts or returns because of it.
  // GOES_ON: the executor lives, and what it was doing goes on.
  template <class Crash>
  void crash(Crash die, bool goes_on = false) {
    const auto starts = starts_so_far();
    const auto reactions = world_.reactions().size();
    const auto& before = world_.durable();
    // A rover by the MAVLink text takes a new plan in flight with a start; that is what was asked for, then.
    const bool is_asked_for = !before.waiting.empty() || before.arrived || before.change || (goes_on && before.doing);
    const bool was_under_way = before.status.in_flight && !is_asked_for;
    die();
    world_.run_for(1);
    if (was_under_way) {
      EXPECT_EQ(starts_so_far(), starts) << "a restart starts nothing\n" << story();
    }
    EXPECT_EQ(world_.reactions().size(), reactions) << "a restart brings nothing home\n" << story();
  }

  void make(trouble what) {
    did_ += std::to_string(world_.now_ns() / 1'000'000) + " ms: " + std::to_string(static_cast<int>(what)) + "\n";
    switch (what) {
    case trouble::crash:
      crash([this] { world_.crash(); });
      break;
    case trouble::crash_of_failsafe:
      crash([this] { world_.crash_failsafe(); }, true);
      break;
    case trouble::kill:
      crash([this] { world_.crash_all(); });
      break;
    case trouble::change:
      change();
      break;
    case trouble::silence:
      world_.cut_line(0.1 * static_cast<double>(test_rng_() % 150));
      break;
    case trouble::pilot:
      take_over();
      break;
    case trouble::pause:
      (void)world_.say(operators::command_kind::pause);
      break;
    case trouble::assignment:
      assign();
      break;
    case trouble::reboot:
      if (!world_.vehicle().describe().in_air) {
        world_.vehicle().reboot(world_.now_ns());
        rebooted_ = true;
      }
      break;
    case trouble::refusal:
      world_.vehicle().refuse_command(176, 4, 1 + static_cast<int>(test_rng_() % 2)); // DO_SET_MODE fails
      break;
    }
  }

  void take_over() {
    if (!world_.durable().status.in_flight)
      return;
    world_.switch_mode(pilot_mode(who_));
    if (!world_.run_until_phase(phase::paused, 8))
      return; // it had landed meanwhile
    const auto commands = world_.commands().size();
    world_.run_for(3);
    if (world_.durable().status.cause == pause_cause::taken_over) {
      EXPECT_EQ(world_.commands().size(), commands) << "nothing is sent after a takeover\n" << story();
    }
  }

  void assign() {
    if (!world_.durable().mission)
      return;
    mission::assignment assignment;
    const auto& now = *world_.durable().mission;
    assignment.assignment_id = "11111111-2222-4333-8444-" + std::to_string(100'000'000'000 + ++assignments_);
    assignment.base_revision = now.revision;
    assignment.revision = now.revision + 1;
    assignment.replace_after_item_id = test_rng_() % 2 == 0 ? "w1" : "w2";
    const auto name = "n" + std::to_string(assignments_);
    assignment.items = {tests::place(who_, name + "a", 20, 20), tests::place(who_, name + "b", -30, 20)};
    if (who_ != sim::personality::rover)
      assignment.items.push_back(tests::way_home(who_));
    world_.assign(assignment);
  }

  // A command of an operator that changes the mission; the service does it, refuses, or is not heard.
  void change() {
    using mission_client::change_verdict;
    world_.set_changes(std::array{change_verdict::done, change_verdict::done, change_verdict::refused,
                                  change_verdict::unknown}[test_rng_() % 4]);
    operators::command command;
    command.kind = std::array{operators::command_kind::go_to, operators::command_kind::insert}[test_rng_() % 2];
    const auto at = static_cast<double>(test_rng_() % 80);
    command.place = std::get<mission::waypoint>(tests::place(who_, "", 40 - at, at)).at;
    (void)world_.say(command);
    world_.run_for(static_cast<double>(test_rng_() % 10));
  }

  // Whoever stands beside it brings it back.
  void help() {
    const auto& at = world_.durable().status;
    if (!world_.vehicle().describe().in_air)
      world_.vehicle().set_battery(100, world_.now_ns());
    if (needs_hand_back(at.cause))
      (void)world_.say(operators::command_kind::hand_back);
    const auto seen = world_.vehicle().describe();
    if (who_ == sim::personality::plane && !seen.in_air && at.in_flight)
      world_.disarm_by_hand(); // in a mode by hand it does not do that itself
    world_.run_for(1);
    if (world_.durable().status.now == phase::paused)
      note_answer(world_.say(operators::command_kind::resume));
    else if (is_waiting_for_person())
      note_answer(world_.say(operators::command_kind::start));
    if (!world_.durable().set_aside.empty())
      note_answer(world_.say(operators::command_kind::cancel));
  }

  void note_answer(const operators::answer& answer) {
    if (!answer.is_taken)
      did_ += std::to_string(world_.now_ns() / 1'000'000) + " ms: refused: " + answer.reason + "\n";
  }

  [[nodiscard]] int starts_so_far() const {
    int result = 0;
    for (const auto each : world_.commands())
      result += each == 300 || each == 400 || each == 22 ? 1 : 0;
    return result;
  }

  void judge() const {
    std::uint32_t number = 0;
    std::uint32_t generation = 0;
    std::map<std::uint32_t, std::uint32_t> last_index;
    std::set<std::int32_t> complete;
    for (const auto& each : world_.reports()) {
      ASSERT_EQ(each.report_no, ++number) << story();
      ASSERT_GE(each.generation, generation) << "no report of an old generation\n" << story();
      generation = each.generation;
      if (each.item_index && each.kind != progress_kind::skipped) {
        auto& last = last_index[generation];
        ASSERT_GE(*each.item_index, last) << "the index never goes back\n" << story();
        last = *each.item_index;
      }
      if (each.kind == progress_kind::complete) {
        ASSERT_TRUE(complete.insert(each.revision).second) << "complete once\n" << story();
      }
    }
    std::set<std::string> answered;
    for (const auto& each : world_.answers())
      ASSERT_TRUE(answered.insert(each.assignment_id).second) << "one answer to an assignment\n" << story();
  }

  // All that the mission has is told of, as reached or as skipped.
  void judge_items() const {
    if (world_.durable().status.now != phase::done)
      return;
    std::set<std::string> told;
    for (const auto& each : world_.reports())
      if (each.kind == progress_kind::reached || each.kind == progress_kind::skipped)
        told.insert(each.item_id.value_or(""));
    for (const auto& each : world_.durable().mission->items)
      EXPECT_TRUE(told.contains(mission::id_of(each))) << mission::id_of(each) << "\n" << story();
  }

  std::mt19937_64 test_rng_;
  sim::personality who_;
  mission::document mission_;
  bool is_map_late_;
  flight_world world_;
  int assignments_ = 0;
  std::string did_; // "2350 ms: 1", by the number of the trouble
  bool rebooted_ = false;
};

#ifdef __SANITIZE_ADDRESS__
constexpr int usual_flights = 300; // each takes many times as long
#else
constexpr int usual_flights = 4'000; // 15 ms each
#endif

int wanted_flights() { return std::getenv("TEST_FULL") != nullptr ? 100'000 : usual_flights; }

// The first seed: TEST_SEED, or 1.
int first_seed() {
  const char* given = std::getenv("TEST_SEED");
  return given != nullptr ? std::atoi(given) : 1;
}

TEST(any_flight, keeps_its_promises_whatever_happens) {
  int over = 0;
  const int flights = wanted_flights();
  for (int seed = first_seed(); seed < first_seed() + flights; ++seed) {
    random_flight flight(static_cast<std::uint64_t>(seed));
    flight.fly();
    over += flight.is_over() ? 1 : 0;
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
    if (!flight.is_over() && !flight.was_disturbed_for_good())
      ADD_FAILURE() << "seed " << seed << " has no end\n" << flight.story();
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(over, flights / 2);
}

TEST(any_flight, is_the_same_again_with_the_same_seed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    random_flight once(seed);
    once.fly();
    random_flight again(seed);
    again.fly();
    ASSERT_EQ(once.story(), again.story()) << "seed " << seed;
  }
}

} // namespace flight_property_test
} // namespace godwit::executor
