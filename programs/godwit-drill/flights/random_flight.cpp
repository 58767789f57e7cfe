#include "programs/godwit-drill/flights/random_flight.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "programs/godwit-drill/flights/actor_names.hpp"

namespace godwit::drill {
namespace {

using executor::phase;
using runtime::crash_point;

enum class trouble {
  kill_process,
  kill_at_commit,
  throw_somewhere,
  kill_actor,
  pilot,
  pause,
  assignment,
  cut,
  service,
  disk,
  clear
};
constexpr std::size_t kinds_of_trouble = 11;
constexpr std::size_t most_troubles = most_faults - 1;
constexpr std::uint64_t far_from_other_seeds = 0x9e37'79b9'7f4a'7c15;
constexpr double on_its_way_s = 0.3; // at most, what was sent before somebody was seen: the delay of a line, overtaken
constexpr std::uint64_t known_vehicles = 3; // the plane is not among them (docs/roadmap.md)

class random_flight {
public:
  random_flight(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
                const std::vector<std::uint64_t>& without)
      : seed_(seed), without_(without), test_rng_(seed),
        who_(drawn(who)), watched_{any_flight(), any_mission(), wishes, "seed " + std::to_string(seed),
                                   std::string(io::name_of(who_))},
        flight_(watched_.flight()) {}

  flight_outcome fly() {
    const auto troubles = test_rng_() % (most_troubles + 1);
    watched_.so_far().faults = troubles + 1;
    for (std::uint64_t number = 1; number <= troubles && !executor::is_at_rest(flight_.status().now); ++number) {
      test_rng_.seed(seed_ + number * far_from_other_seeds);
      flight_.run_for(0.05 * static_cast<double>(test_rng_() % 200));
      const auto what = static_cast<trouble>(test_rng_() % kinds_of_trouble);
      if (is_made(number))
        make(what);
    }
    return watched_.finish();
  }

private:
  [[nodiscard]] bool is_made(std::uint64_t number) const {
    return std::ranges::find(without_, number) == without_.end();
  }

  // Drawn also when it is named, so that the rest of the flight is the same.
  sim::personality drawn(std::optional<sim::personality> who) {
    const auto any = static_cast<sim::personality>(test_rng_() % known_vehicles);
    return who.value_or(any);
  }

  // Half of the lines lose, double, delay and mix up frames.
  flight_simulation::options any_flight() {
    flight_simulation::options result{.who = who_, .seed = seed_};
    const bool is_good = test_rng_() % 2 == 0;
    sim::line_settings line;
    line.loss = 0.01 * static_cast<double>(test_rng_() % 6);
    line.duplication = 0.01 * static_cast<double>(test_rng_() % 6);
    line.reorder = 0.01 * static_cast<double>(test_rng_() % 4);
    line.delay = std::chrono::milliseconds(20 * (test_rng_() % 10));
    const auto late = 0.002 * static_cast<double>(test_rng_() % 6);
    if (is_good || !is_made(0))
      return result;
    result.line.in = result.line.out = line;
    result.line.out.late = late;
    return result;
  }

  // Half of them inside a fence.
  mission::document any_mission() {
    auto result = short_mission(who_);
    if (test_rng_() % 2 == 0)
      result.geofences.push_back(fence_around(250));
    return result;
  }

  const char* any_actor() { return actor_names[test_rng_() % actor_names.size()]; }

  void make(trouble what) {
    switch (what) {
    case trouble::kill_process:
      return flight_.kill_process();
    case trouble::kill_at_commit:
      return flight_.kill_process_at_commit(flight_.commits() + 1 + test_rng_() % 5,
                                            static_cast<flight_simulation::side>(test_rng_() % 2));
    case trouble::throw_somewhere:
      if (auto* process = flight_.process()) {
        process->crash_at(any_actor(), static_cast<crash_point>(test_rng_() % 4));
        ++watched_.so_far().crashes;
      }
      return;
    case trouble::kill_actor:
      if (auto* process = flight_.process())
        watched_.so_far().crashes += process->kill(any_actor()) ? 1 : 0;
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
    case trouble::disk:
      return stall_disk(0.5 * static_cast<double>(1 + test_rng_() % 12));
    case trouble::clear:
      return flight_.station().clear_mission();
    }
  }

  // Nothing is written meanwhile; a process that is killed comes back with a disk that writes.
  void stall_disk(double seconds) {
    if (auto* process = flight_.process())
      process->fail_journal(true);
    flight_.run_for(seconds);
    if (auto* process = flight_.process())
      process->fail_journal(false);
  }

  std::uint32_t any_mode_of_pilot() {
    const std::array modes{pilot_mode(who_), hold_mode(who_),
                           who_ == sim::personality::rover ? pilot_mode(who_) : landing_mode(who_)};
    return modes.at(test_rng_() % modes.size());
  }

  // From the start to the last leg; a kill of the process meanwhile changes nothing.
  void take_over() {
    const auto& at = flight_.status();
    const bool flies = at.now == phase::starting || at.now == phase::flying || at.now == phase::landing;
    if (!flies || !flight_.vehicle().describe().armed)
      return;
    flight_.switch_mode(any_mode_of_pilot());
    if (!flight_.run_until_phase(phase::paused, 8) || flight_.status().cause != executor::pause_cause::taken_over)
      return; // it had come to its end meanwhile
    ++watched_.so_far().takeovers;
    flight_.run_for(on_its_way_s);
    const auto since_ns = flight_.now_ns();
    if (test_rng_() % 3 == 0)
      flight_.kill_process();
    flight_.run_for(4);
    watched_.expect(moves_since(flight_, since_ns) == 0 ? "" : "something was commanded after a takeover");
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

  std::uint64_t seed_;
  const std::vector<std::uint64_t>& without_;
  std::mt19937_64 test_rng_;
  sim::personality who_;
  watched_flight watched_;
  flight_simulation& flight_;
  int assignments_ = 0;
};

} // namespace

flight_outcome fly_random(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
                          const std::vector<std::uint64_t>& without) {
  return random_flight(seed, who, wishes, without).fly();
}

} // namespace godwit::drill
