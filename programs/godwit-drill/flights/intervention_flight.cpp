#include "programs/godwit-drill/flights/intervention_flight.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>

#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "programs/godwit-drill/flights/one_of.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::drill {
namespace {

using executor::phase;
using operators::command_kind;

enum class whereabouts { other_line, same_line, ground_port };
enum class act { disarm, mode, upload, choose_item, set_home };

constexpr double foreign_is_m_away = 150; // so that a report about it is not true of ours
constexpr std::uint64_t one_in_flies_on = 4;

class intervention_flight {
public:
  intervention_flight(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
                      const std::vector<std::uint64_t>& without)
      : seed_(seed), without_(without), rng_(seed), who_(drawn(who)),
        place_(any_place()), watched_{any_flight(), short_mission(who_), wishes, "seed " + std::to_string(seed),
                                      std::string(io::name_of(who_)) + "/" + name_of(place_)},
        flight_(watched_.flight()) {}

  flight_outcome fly() {
    const auto acts = 1 + rng_() % most_interventions;
    const bool flies_on = rng_() % one_in_flies_on == 0 && starts_by_itself_; // nobody starts it else
    watched_.so_far().faults = acts + 1;
    for (std::uint64_t number = 1; number <= acts && !executor::is_at_rest(flight_.status().now); ++number) {
      rng_.seed(seed_ + number * far_from_other_seeds);
      intervene(is_made(number));
    }
    constexpr double reports_come_within_s = 8;
    if (has_moved_home_)
      come_home();
    else if (flies_on && !has_gone_somewhere_) // where it would wait for ever
      return watched_.finish_or_wait();
    flight_.run_for(reports_come_within_s);
    return watched_.judge();
  }

private:
  [[nodiscard]] bool is_made(std::uint64_t number) const {
    return std::ranges::find(without_, number) == without_.end();
  }

  static std::string name_of(whereabouts where) {
    return where == whereabouts::other_line  ? "other line"
           : where == whereabouts::same_line ? "same line"
                                             : "ground port";
  }

  sim::personality drawn(std::optional<sim::personality> who) {
    const auto any = one_of(std::array{sim::personality::px4, sim::personality::px4, sim::personality::ardupilot,
                                       sim::personality::ardupilot, sim::personality::rover},
                            rng_);
    return who.value_or(any);
  }
  whereabouts any_place() {
    return one_of(std::array{whereabouts::other_line, whereabouts::other_line, whereabouts::same_line,
                             whereabouts::same_line, whereabouts::ground_port},
                  rng_);
  }

  flight_simulation::options any_flight() {
    starts_by_itself_ = rng_() % 2 == 0;
    flight_simulation::options result{.who = who_, .seed = seed_, .starts_by_itself = starts_by_itself_};
    result.speed = 1;
    result.stream_factor = 1;
    result.is_shuffled = rng_() % 4 == 0;
    result.is_person_on_other_line = place_ == whereabouts::other_line;
    result.speaks_as_autopilot = rng_() % 2 == 0;
    sim::line_settings line;
    delay_ns_ = static_cast<std::int64_t>(5 + rng_() % 100) * 1'000'000;
    line.delay = std::chrono::nanoseconds(delay_ns_);
    const auto loss = 0.01 * static_cast<double>(rng_() % 6);
    if (rng_() % 3 == 0 && is_made(0))
      line.loss = loss;
    result.line.in = result.line.out = line;
    return result;
  }

  // -- what brings godwit to send orders ------------------------------------------------------------

  // A word of an operator that fits, or nothing: the flight goes its way.
  void provoke() {
    const auto& at = flight_.status();
    if (executor::needs_hand_back(at.cause)) {
      flight_.say(command_kind::hand_back);
      flight_.run_for(0.5);
    }
    if (at.now == phase::paused)
      return flight_.say(rng_() % 4 == 0 ? command_kind::come_home : command_kind::resume);
    if (at.now == phase::ready)
      return flight_.say(command_kind::start);
    if (at.now != phase::flying || rng_() % 3 == 0)
      return;
    switch (rng_() % 4) {
    case 0:
      return flight_.say(command_kind::pause);
    case 1:
      return flight_.say(command_kind::come_home);
    default:
      return go_somewhere();
    }
  }

  void go_somewhere() {
    operators::command wanted;
    has_gone_somewhere_ = true;
    wanted.kind = command_kind::go_to;
    wanted.place = std::get<mission::waypoint>(place(who_, "there", 30, -40)).at;
    flight_.say(std::move(wanted));
  }

  // Home was moved: a return still leads to where the mission has its own.
  void come_home() {
    constexpr double comes_within_s = 200;
    constexpr double near_m = 15;
    const auto flies = flight_.vehicle().describe();
    if (executor::needs_hand_back(flight_.status().cause) || !flies.armed || !flies.in_air)
      return; // somebody has it, or it stands
    flight_.say(command_kind::come_home);
    const auto is_down = [&] { return !flight_.vehicle().describe().armed; };
    if (!flight_.run_until(is_down, comes_within_s) || executor::needs_hand_back(flight_.status().cause))
      return;
    const auto home = short_mission(who_).return_point.value();
    const auto away_m = sim::between(flight_.vehicle().describe().where, {home.latitude, home.longitude, 0}).distance_m;
    watched_.expect(away_m <= near_m
                        ? ""
                        : "people: home: it was called home, and has landed " +
                              std::to_string(static_cast<int>(away_m)) + " m from the mission's return point");
  }

  // -- what a person does ---------------------------------------------------------------------------

  // In time with an order: just before it arrives, at once after it, or within a second.
  std::int64_t any_delay_ns() {
    switch (rng_() % 3) {
    case 0:
      return static_cast<std::int64_t>(rng_() % static_cast<std::uint64_t>(delay_ns_));
    case 1:
      return delay_ns_ + static_cast<std::int64_t>(rng_() % 200'000'000);
    default:
      return static_cast<std::int64_t>(rng_() % 1'000'000'000);
    }
  }

  void intervene(bool is_made) {
    constexpr double watched_s = 6;
    // A heartbeat of the person's station, as a PX4 wants one before it says anything.
    if (place_ != whereabouts::ground_port)
      flight_.person().send_heartbeat();
    const auto skip = static_cast<int>(rng_() % 4);
    const auto what = one_of(std::array{act::disarm, act::disarm, act::mode, act::mode, act::mode, act::upload,
                                        act::choose_item, act::set_home},
                             rng_);
    const auto draws = rng_();
    const auto after_ns = any_delay_ns();
    const auto act = [this, what, draws, is_made] {
      if (!is_made)
        return;
      std::mt19937_64 own(draws);
      perform(what, own);
    };
    if (place_ == whereabouts::ground_port && rng_() % 2 == 0 && fly_a_while())
      act(); // whoever flies by a station does so at any time
    else
      act_at_order(skip, after_ns, act);
    flight_.run_for(watched_s);
    watched_.so_far().takeovers += executor::needs_hand_back(flight_.status().cause) ? 1 : 0;
  }

  // False: it does not fly.
  bool fly_a_while() {
    constexpr double flies_within_s = 20;
    const auto flies = [&] {
      const auto seen = flight_.vehicle().describe();
      return flight_.status().now == phase::flying && (seen.in_air || seen.ground_speed_mps > 1);
    };
    if (flight_.status().now == phase::ready || flight_.status().now == phase::paused)
      provoke();
    if (!flight_.run_until(flies, flies_within_s))
      return false;
    flight_.run_for(0.01 * static_cast<double>(rng_() % 1'000));
    return flies();
  }

  void act_at_order(int skip, std::int64_t after_ns, const std::function<void()>& act) {
    constexpr double order_comes_within_s = 15;
    flight_.when_ordered(skip, after_ns, act);
    (void)flight_.run_until([&] { return !flight_.has_planned_act() || is_waiting(); }, order_comes_within_s);
    if (flight_.has_planned_act()) {
      provoke();
      (void)flight_.run_until([&] { return !flight_.has_planned_act(); }, order_comes_within_s);
    }
    flight_.forget_planned_act();
  }

  [[nodiscard]] bool is_waiting() const {
    const auto now = flight_.status().now;
    return now == phase::paused || now == phase::flying || (now == phase::ready && !starts_by_itself_);
  }

  void perform(act what, std::mt19937_64& random) {
    if (place_ == whereabouts::ground_port)
      return perform_through_port(what, random);
    auto& person = flight_.person();
    switch (what) {
    case act::disarm:
      flight_.note("a person disarms");
      return person.disarm(random() % 4 == 0 && !flight_.vehicle().describe().in_air);
    case act::mode:
      return flight_.switch_mode(any_mode(random), one_of(all_mode_forms, random));
    case act::upload:
      flight_.note("a person uploads another plan");
      return person.upload(foreign_plan());
    case act::choose_item: {
      const auto count = static_cast<std::uint64_t>(std::max(flight_.vehicle().describe().mission_count, 1));
      flight_.note("a person chooses an item");
      return person.choose_item(static_cast<std::uint16_t>(random() % count),
                                who_ == sim::personality::px4 || random() % 2 == 0);
    }
    case act::set_home:
      flight_.note("a person moves home");
      has_moved_home_ = true;
      return person.set_home(
          sim::moved(flight_.vehicle().describe().where, {static_cast<double>(random() % 360), 200}));
    }
  }

  // What a station sends to the autopilot that it sees there.
  void perform_through_port(act what, std::mt19937_64& random) {
    auto& station = flight_.station();
    if (what == act::disarm) {
      flight_.note("a station disarms");
      return station.command(io::mavlink::mav_cmd::component_arm_disarm, 0);
    }
    const auto mode = any_mode(random);
    const auto how = one_of(all_mode_forms, random);
    flight_.note("a station changes to mode " + std::to_string(mode) + " by " + std::string(io::name_of(how)));
    simulated_person as_station(simulated_station::self,
                                [&](std::span<const std::byte> frame) { station.send_frame(frame); });
    as_station.change_mode(who_, mode, how);
  }

  std::uint32_t any_mode(std::mt19937_64& random) const {
    const auto modes = modes_of(who_);
    return modes[random() % modes.size()].custom;
  }

  simulated_person::plan foreign_plan() {
    auto result = flight_.vehicle().mission_items();
    constexpr double e7_of_metre = 1e7 / 75'300; // of longitude, at the home of simulated vehicles
    for (auto& each : result)
      if (each.x != 0 || each.y != 0)
        each.y += static_cast<std::int32_t>(foreign_is_m_away * e7_of_metre);
    return result;
  }

  std::uint64_t seed_;
  const std::vector<std::uint64_t>& without_;
  std::mt19937_64 rng_;
  sim::personality who_;
  whereabouts place_;
  bool starts_by_itself_ = true;
  bool has_gone_somewhere_ = false;
  bool has_moved_home_ = false;
  std::int64_t delay_ns_ = 0;
  watched_flight watched_;
  flight_simulation& flight_;
};

} // namespace

flight_outcome fly_intervention(std::uint64_t seed, std::optional<sim::personality> who, const flight_wishes& wishes,
                                const std::vector<std::uint64_t>& without) {
  return intervention_flight(seed, who, wishes, without).fly();
}

} // namespace godwit::drill
