// Any order of kills, throws, pilots, pauses, assignments, cut lines and faults of the service, on every vehicle, on
// the real composition: what must hold whatever happens.
//
// TEST_SEED=n runs flight n first, TEST_FULL=1 many more of them.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "tests/support/run_options.hpp"

namespace {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::tests;
using executor::phase;
using runtime::crash_point;

constexpr std::array actors{"vehicle_link",   "failsafe", "mapobjects_store",
                            "mission_client", "executor", "ground_port"};

enum class trouble {
  kill_process,
  kill_at_commit,
  throw_somewhere,
  kill_actor,
  pilot,
  pause,
  assignment,
  cut,
  service
};
constexpr std::size_t kinds_of_trouble = 9;
constexpr std::size_t most_troubles = 6;

class random_flight {
public:
  explicit random_flight(std::uint64_t seed)
      : test_rng_(seed), who_(static_cast<sim::personality>(test_rng_() % 3)),
        flight_(any_flight(test_rng_, who_, seed)) {}

  void fly() {
    const auto troubles = test_rng_() % (most_troubles + 1);
    for (std::size_t i = 0; i < troubles && !executor::is_at_rest(flight_.status().now); ++i) {
      flight_.run_for(0.05 * static_cast<double>(test_rng_() % 200));
      make(static_cast<trouble>(test_rng_() % kinds_of_trouble));
    }
    EXPECT_TRUE(fly_with_help(flight_)) << "it has no end\n" << flight_.story();
    EXPECT_EQ(flaw_of_end(flight_), "") << flight_.story();
    EXPECT_EQ(flaw_of_reports(flight_), "") << flight_.story();
  }

private:
  // Half of the lines lose and double frames.
  static flight_simulation::options any_flight(std::mt19937_64& test_rng, sim::personality who, std::uint64_t seed) {
    flight_simulation::options result{.who = who, .seed = seed};
    if (test_rng() % 2 == 0)
      return result;
    result.line.in.loss = result.line.out.loss = 0.01 * static_cast<double>(test_rng() % 6);
    result.line.in.duplication = result.line.out.duplication = 0.01 * static_cast<double>(test_rng() % 6);
    return result;
  }

  const char* any_actor() { return actors[test_rng_() % actors.size()]; }

  void make(trouble what) {
    switch (what) {
    case trouble::kill_process:
      return flight_.kill_process();
    case trouble::kill_at_commit:
      return flight_.kill_process_at_commit(flight_.commits() + 1 + test_rng_() % 5,
                                            static_cast<flight_simulation::side>(test_rng_() % 2));
    case trouble::throw_somewhere:
      if (auto* process = flight_.process())
        process->crash_at(any_actor(), static_cast<crash_point>(test_rng_() % 4));
      return;
    case trouble::kill_actor:
      if (auto* process = flight_.process())
        (void)process->kill(any_actor());
      return;
    case trouble::pilot:
      return take_over();
    case trouble::pause:
      return flight_.say(operators::command_kind::pause);
    case trouble::assignment:
      return assign();
    case trouble::cut:
      return flight_.cut_line(0.1 * static_cast<double>(test_rng_() % 100));
    case trouble::service:
      return flight_.service().set_fault(std::array{"lose on post-progress times 2", "status 503 times 3",
                                                    "drop times 3", "delay 2s times 2"}[test_rng_() % 4]);
    }
  }

  // In the middle of a mission; a kill of the process meanwhile changes nothing.
  void take_over() {
    const auto& at = flight_.status();
    if (!at.in_flight || at.now != phase::flying || !flight_.vehicle().describe().armed)
      return;
    flight_.switch_mode(pilot_mode(who_));
    if (!flight_.run_until_phase(phase::paused, 8) || flight_.status().cause != executor::pause_cause::taken_over)
      return; // it had come to its end meanwhile
    const auto since_ns = flight_.now_ns();
    if (test_rng_() % 3 == 0)
      flight_.kill_process();
    flight_.run_for(4);
    EXPECT_EQ(moves_since(flight_, since_ns), 0) << "nothing is commanded after a takeover\n" << flight_.story();
  }

  void assign() {
    if (flight_.reports().empty())
      return;
    const auto name = "n" + std::to_string(++assignments_);
    sim::missions::assignment_request wanted;
    wanted.replace_after_item_id = test_rng_() % 2 == 0 ? "w1" : "w2";
    wanted.items = {place(who_, name + "a", 20, 20), place(who_, name + "b", -30, 20)};
    if (who_ != sim::personality::rover)
      wanted.items.push_back(way_home(who_, name + "home"));
    (void)flight_.service().assign(flight_.mission_id(), wanted, flight_.now_ns());
  }

  std::mt19937_64 test_rng_;
  sim::personality who_;
  flight_simulation flight_;
  int assignments_ = 0;
};

TEST(random_flight, keeps_its_promises_whatever_happens) {
  const std::uint64_t flights = is_full_run() ? 5'000 : 60;
  for (auto seed = first_seed(); seed < first_seed() + flights; ++seed) {
    random_flight flight(seed);
    flight.fly();
    ASSERT_FALSE(HasFailure()) << "again: TEST_SEED=" << seed << " test_flight_simulation "
                               << "--gtest_filter=random_flight.*";
  }
}

} // namespace
