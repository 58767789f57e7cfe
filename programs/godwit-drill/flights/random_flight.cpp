#include "programs/godwit-drill/flights/random_flight.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <string>

#include "io/mavlink/messages/position.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/scan_mission.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"
#include "programs/godwit-sim/vehicle/autopilot/stream_table.hpp"

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
constexpr double on_its_way_s = 0.3; // at most, what was sent before somebody was seen: the delay of a line, overtaken
constexpr std::uint64_t known_vehicles = 3; // the plane is not among them (docs/roadmap.md)
// By the seed itself, so that the others stay as they are.
constexpr std::uint64_t one_in_is_long = 100;
constexpr std::uint64_t one_in_has_survey = 10;
constexpr double long_takes_longer = 5; // and what happens in it lies farther apart

enum class flown { short_mission, long_mission, survey };

flown what_is_flown(std::uint64_t seed) {
  if (seed % one_in_is_long == 0)
    return flown::long_mission;
  return seed % one_in_has_survey == 1 ? flown::survey : flown::short_mission;
}

// With which the vehicle tells so many positions in a second of its world.
double stream_factor_of(sim::personality who, double hz) {
  const auto streams = who == sim::personality::px4         ? sim::px4_streams()
                       : who == sim::personality::ardupilot ? sim::ardupilot_streams()
                                                            : sim::rover_streams();
  const auto position = std::ranges::find(streams, std::uint32_t{io::mavlink::global_position_int::message_id},
                                          &sim::role::streamed_message::id);
  return hz * static_cast<double>(position->interval_ns) * 1e-9;
}

class random_flight {
public:
  random_flight(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
                const std::vector<std::uint64_t>& without)
      : seed_(seed), flown_(what_is_flown(seed)), without_(without), test_rng_(seed),
        who_(drawn(who)), watched_{any_flight(wishes), any_mission(), wishes, "seed " + std::to_string(seed),
                                   std::string(io::name_of(who_))},
        flight_(watched_.flight()) {}

  flight_outcome fly() {
    const auto troubles = test_rng_() % (most_troubles + 1);
    watched_.so_far().faults = troubles + 1;
    for (std::uint64_t number = 1; number <= troubles && !executor::is_at_rest(flight_.status().now); ++number) {
      test_rng_.seed(seed_ + number * far_from_other_seeds);
      const double apart = flown_ == flown::short_mission ? 1 : long_takes_longer;
      flight_.run_for(apart * 0.05 * static_cast<double>(test_rng_() % 200));
      if (flown_ == flown::survey)
        look_around(number);
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
  flight_simulation::options any_flight(const flight_wishes& wishes) {
    flight_simulation::options result{.who = who_, .seed = seed_};
    if (wishes.stream_hz)
      result.stream_factor = stream_factor_of(who_, *wishes.stream_hz / result.speed);
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
    auto result = flown_ == flown::long_mission ? long_mission(who_)
                  : flown_ == flown::survey     ? scan_mission(who_)
                                                : short_mission(who_);
    if (test_rng_() % 2 == 0 && flown_ != flown::survey) // which is wider
      result.geofences.push_back(fence_around(250));
    return result;
  }

  // Something is seen; of what was seen before, a person has something to say.
  void look_around(std::uint64_t number) {
    constexpr double apart_m = 40;
    const auto seen = seen_in_survey(flight_, "00000000-0000-4000-8000-00000000000" + std::to_string(number),
                                     apart_m * static_cast<double>(number), 0.9);
    auto* process = flight_.process();
    if (process == nullptr) {
      flight_.outside().seen.push_back(seen);
      return;
    }
    process->see(seen);
    if (number > 1 && process->points())
      (void)process->decide({number - 1,
                             number % 2 == 0 ? scan_controller::decision::confirm : scan_controller::decision::decline,
                             "drill"});
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
    const bool flies = at.now == phase::starting || executor::is_on_way(at.now);
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
  flown flown_;
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
