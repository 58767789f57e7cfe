#include "programs/godwit-drill/flights/cut_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "io/mavlink/enums.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "programs/godwit-drill/flights/one_of.hpp"

namespace godwit::drill {
namespace {

using executor::phase;
using io::mavlink::mav_cmd;
using io::mavlink::number;
using operators::command_kind;

// The order that is under way as the line is cut.
enum class moment { arm, start, replan, pause, resume, come_home };
enum class intruder { nobody, mode, hold, disarm, arm, disarm_and_arm };
enum class end_of { nothing, executor, process };

constexpr double shortest_s = 0.2;
constexpr double longest_s = 30;
constexpr double heard_within_s = 3; // after a cut: heartbeats come each second, and some are lost
constexpr double told_within_s = 3;

class cut_flight {
public:
  cut_flight(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
             const std::vector<std::uint64_t>& without)
      : seed_(seed), without_(without), rng_(seed),
        who_(drawn(who)), watched_{any_flight(), short_mission(who_), wishes, "seed " + std::to_string(seed),
                                   std::string(io::name_of(who_))},
        flight_(watched_.flight()) {}

  flight_outcome fly() {
    const auto cuts = 1 + rng_() % most_cuts;
    watched_.so_far().faults = cuts + 1;
    for (std::uint64_t number = 1; number <= cuts && !executor::is_at_rest(flight_.status().now); ++number) {
      rng_.seed(seed_ + number * far_from_other_seeds);
      cut(std::ranges::find(without_, number) == without_.end());
    }
    auto& outcome = watched_.so_far();
    outcome.takeovers += executor::needs_hand_back(flight_.status().cause) ? 1 : 0;
    if (!executor::is_at_rest(flight_.status().now))
      end_flight();
    watched_.expect(flaw_of_skipped());
    return watched_.judge();
  }

private:
  sim::personality drawn(std::optional<sim::personality> who) {
    const auto any =
        one_of(std::array{sim::personality::px4, sim::personality::ardupilot, sim::personality::ardurover}, rng_);
    return who.value_or(any);
  }

  flight_simulation::options any_flight() {
    flight_simulation::options result{.who = who_, .seed = seed_, .starts_by_itself = false};
    result.speed = 1;
    result.stream_factor = 1;
    result.is_shuffled = rng_() % 4 == 0;
    result.is_person_on_other_line = rng_() % 3 != 0;
    result.beats_at_mode_change = rng_() % 2 == 0;
    sim::line_settings line;
    delay_s_ = 0.001 * static_cast<double>(1 + rng_() % 100);
    line.delay = std::chrono::nanoseconds(static_cast<std::int64_t>(delay_s_ * 1e9));
    const auto loss = 0.01 * static_cast<double>(rng_() % 6);
    if (rng_() % 4 == 0 && std::ranges::find(without_, 0U) == without_.end())
      line.loss = loss;
    result.line.in = result.line.out = line;
    return result;
  }

  double any_share() { return static_cast<double>(rng_() >> 11U) * 0x1p-53; } // 0 to 1

  // -- the order that is cut off ----------------------------------------------------------------------

  [[nodiscard]] bool is_of(moment what, const io::mavlink::frame_view& frame) const {
    if (frame.from() != godwit_id)
      return false;
    const auto order = moving_order_in(frame, who_);
    const auto mode = custom_mode_in(frame, who_);
    switch (what) {
    case moment::arm:
      return order == moving_order::arm;
    case moment::start:
    case moment::resume:
      return order == moving_order::start || order == moving_order::mission_mode;
    case moment::replan: // PX4 is not held for it
      return (mode && order == moving_order::none) || frame.id() == io::mavlink::mission_count::message_id;
    case moment::pause:
    case moment::come_home:
      return mode && order == moving_order::none;
    }
    return false;
  }

  // Where the order can be given. False: the flight does not come there.
  bool come_to(moment what) {
    constexpr double most_s = 60;
    const auto& at = flight_.status();
    if (executor::needs_hand_back(at.cause)) {
      flight_.say(command_kind::hand_back);
      flight_.run_for(1);
    }
    if (what == moment::arm || what == moment::start) {
      if (at.now == phase::paused && !flight_.vehicle().describe().armed)
        flight_.say(command_kind::resume);
      return (at.now == phase::preflight || !at.in_flight) && flight_.run_until_phase(phase::ready, most_s);
    }
    if (what == moment::resume && at.now == phase::paused)
      return true;
    if (at.now != phase::flying) {
      (void)flight_.run_until([&] { return at.now == phase::ready || at.now == phase::paused; }, most_s);
      flight_.say(at.now == phase::ready ? command_kind::start : command_kind::resume);
      if (!flight_.run_until_phase(phase::flying, 20))
        return false;
    }
    flight_.run_for(20 * any_share());
    if (what != moment::resume)
      return at.now == phase::flying;
    flight_.say(command_kind::pause);
    return flight_.run_until_phase(phase::paused, 20);
  }

  void order(moment what) {
    switch (what) {
    case moment::arm:
    case moment::start:
      return flight_.say(command_kind::start);
    case moment::replan:
      return assign();
    case moment::pause:
      return flight_.say(command_kind::pause);
    case moment::resume:
      return flight_.say(command_kind::resume);
    case moment::come_home:
      return flight_.say(command_kind::come_home);
    }
  }

  void assign() {
    const auto name = "n" + std::to_string(++assignments_);
    sim::missions::assignment_request wanted;
    wanted.replace_after_item_id = "w2";
    wanted.items = {place(who_, name + "a", 20, 20), place(who_, name + "b", -30, 20)};
    if (!sim::drives(who_))
      wanted.items.push_back(way_home(who_, name + "home"));
    (void)flight_.service().assign(flight_.mission_id(), wanted, flight_.now_ns());
  }

  // -- the cut and what goes with it ------------------------------------------------------------------

  // Before the order arrives, between it and its answer, or after that.
  double any_delay_s() {
    switch (rng_() % 3) {
    case 0:
      return delay_s_ * any_share();
    case 1:
      return delay_s_ * (1 + any_share());
    default:
      return 2 * delay_s_ + any_share();
    }
  }

  void cut(bool is_made) {
    constexpr double order_comes_within_s = 15;
    const auto what = one_of(std::array{moment::arm, moment::start, moment::start, moment::replan, moment::pause,
                                        moment::resume, moment::come_home},
                             rng_);
    if (!come_to(what))
      return;
    const auto after_s = any_delay_s();
    const auto silent_s = shortest_s * std::pow(longest_s / shortest_s, any_share());
    const auto which = rng_() % 3;
    flight_.when_sent([this, what](const io::mavlink::frame_view& frame) { return is_of(what, frame); },
                      static_cast<std::int64_t>(after_s * 1e9),
                      [this, is_made, silent_s, which] {
                        if (is_made)
                          flight_.cut_line(silent_s, which == 0   ? std::nullopt
                                                     : which == 1 ? std::optional(sim::way::in)
                                                                  : std::optional(sim::way::out));
                      });
    order(what);
    (void)flight_.run_until([&] { return !flight_.has_planned_act(); }, order_comes_within_s);
    if (flight_.has_planned_act())
      return flight_.forget_planned_act();
    disturb(silent_s, is_made);
  }

  void disturb(double silent_s, bool is_made) {
    const auto who = one_of(std::array{intruder::nobody, intruder::mode, intruder::hold, intruder::disarm,
                                       intruder::arm, intruder::disarm_and_arm},
                            rng_);
    const auto what = one_of(std::array{end_of::nothing, end_of::nothing, end_of::executor, end_of::process}, rng_);
    const auto person_s = (silent_s + 1) * any_share();
    const auto end_s = silent_s * any_share();
    const auto ends_at = [&](double seconds) {
      flight_.run_for(seconds);
      if (is_made)
        end(what);
    };
    if (end_s < person_s)
      ends_at(end_s);
    flight_.run_for(end_s < person_s ? person_s - end_s : person_s);
    if (is_made)
      intrude(who);
    if (end_s >= person_s)
      ends_at(end_s - person_s);
    flight_.run_for(std::max(silent_s - std::max(end_s, person_s), 0.0) + heard_within_s + 5 * any_share());
    expect_told_as_armed();
  }

  void end(end_of what) {
    auto* process = flight_.process();
    if (process == nullptr || what == end_of::nothing)
      return;
    if (what == end_of::process)
      return flight_.kill_process();
    flight_.note("the executor ends");
    watched_.so_far().crashes += process->kill("executor") ? 1 : 0;
  }

  void intrude(intruder who) {
    constexpr double between_s = 0.5;
    auto& person = flight_.person();
    switch (who) {
    case intruder::nobody:
      return;
    case intruder::mode:
      return flight_.switch_mode(pilot_mode(who_), one_of(all_mode_forms, rng_));
    case intruder::hold:
      return flight_.switch_mode(hold_mode(who_), one_of(all_mode_forms, rng_));
    case intruder::disarm:
      flight_.note("a person disarms");
      return person.disarm();
    case intruder::arm:
      return arm_by_hand();
    case intruder::disarm_and_arm:
      flight_.note("a person disarms");
      person.disarm();
      flight_.run_for(between_s);
      return arm_by_hand();
    }
  }

  void arm_by_hand() {
    flight_.note("a person arms");
    has_person_armed_ = true;
    flight_.person().arm();
  }

  // With the help of people: of an operator who starts and resumes it, and of whoever stands beside it.
  void end_flight() {
    constexpr int most_times = 8;
    constexpr double patience_s = 15;
    const auto ends = [&] { return executor::is_at_rest(flight_.status().now) || has_nothing_to_fly(flight_); };
    const auto& at = flight_.status();
    for (int i = 0; i < most_times && !ends() && !waits_for_another_mission(flight_); ++i) {
      if (executor::needs_hand_back(at.cause)) {
        flight_.say(command_kind::hand_back);
        flight_.run_for(1);
      }
      const auto seen = flight_.vehicle().describe();
      const bool is_beside_it = seen.armed && !seen.in_air && at.now != phase::flying && seen.ground_speed_mps < 0.1;
      if (is_beside_it)
        flight_.person().disarm();
      else if (seen.in_air && !at.in_flight)
        flight_.switch_mode(landing_mode(who_)); // it is a person's
      if (at.now == phase::ready)
        flight_.say(command_kind::start);
      else if (at.now == phase::paused)
        flight_.say(i % 2 == 0 ? command_kind::resume : command_kind::come_home); // nothing may be left but this
      flight_.run_for(1.5);
      (void)flight_.run_until([&] { return ends() || at.now == phase::ready || at.now == phase::paused; },
                              at.now == phase::flying ? 200 : patience_s);
    }
    watched_.expect(ends() || waits_for_another_mission(flight_) ? "" : "it has no end");
  }

  // -- what must hold ---------------------------------------------------------------------------------

  // After a start that failed, of one that nobody but godwit has armed.
  void expect_told_as_armed() {
    const auto is_told = [&] {
      const auto seen = flight_.vehicle().describe();
      const auto& at = flight_.status();
      return !seen.armed || at.in_flight || at.now != phase::paused || executor::needs_hand_back(at.cause) ||
             has_person_armed_ || at.reason.find("armed") != std::string::npos;
    };
    watched_.expect(flight_.run_until(is_told, told_within_s) ? "" : "the vehicle stands armed, and nobody is told");
  }

  // What it came to was not skipped.
  std::string flaw_of_skipped() {
    constexpr double reached_m = 1.5;
    const auto mission = flight_.service().mission(flight_.mission_id());
    for (const auto& each : flight_.reports()) {
      if (each.kind != mission::progress_kind::skipped)
        continue;
      for (const auto& item : mission.items) {
        const auto* place = std::get_if<mission::waypoint>(&item);
        if (place != nullptr && place->id == each.item_id &&
            flight_.track().was_near(place->at, reached_m, flight_.now_ns()))
          return "report " + std::to_string(each.report_no) + " says that " + place->id +
                 " was skipped, and it was reached";
      }
    }
    return {};
  }

  std::uint64_t seed_;
  const std::vector<std::uint64_t>& without_;
  std::mt19937_64 rng_;
  sim::personality who_;
  double delay_s_ = 0;
  int assignments_ = 0;
  bool has_person_armed_ = false;
  watched_flight watched_;
  flight_simulation& flight_;
};

} // namespace

flight_outcome fly_cut(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
                       const std::vector<std::uint64_t>& without) {
  return cut_flight(seed, who, wishes, without).fly();
}

} // namespace godwit::drill
