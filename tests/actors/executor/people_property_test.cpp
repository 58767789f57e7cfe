// Random flights in which people do what people do: change the mode, arm, disarm, land, hand back and resume at any
// moment, also between two steps of a start, on the last leg, on the ground and while godwit is dead.
//
// What is checked is what a person beside the vehicle cares for: nothing is sent after a takeover that was heard,
// nothing starts that nobody has started, and no report is untrue by the vehicle's own track. The same flights each
// time, so that a change is judged and not its luck; TEST_SEED=number flies others, from that one on.
#include <array>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/run_options.hpp"

namespace godwit::executor {
namespace people_property_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;

constexpr std::uint16_t start_command = 300;
constexpr double step_s = 0.05;
// Acceptance radius and some metres; of a plane, which also passes a place on its turning circle.
constexpr double reached_within_m = 10;
constexpr double plane_reached_within_m = 50;
constexpr double home_within_m = 20;
constexpr double plane_home_within_m = 150;              // after its run along the runway
constexpr std::int64_t report_takes_ns = 12'000'000'000; // over a line that was silent
constexpr int most_deeds = 14;
constexpr std::int64_t order_counts_ns = flight::order_is_expected_ns + 1'000'000'000;

std::uint32_t px4(std::uint32_t main, std::uint32_t sub = 0) { return main << 16U | sub << 24U; }

// All that the simulated vehicle has.
std::vector<std::uint32_t> modes_of(personality who) {
  if (who == personality::px4)
    return {px4(1), px4(2), px4(3), px4(7), px4(4, 3), px4(4, 4), px4(4, 5), px4(4, 6)};
  if (who == personality::ardupilot)
    return {0, 2, 3, 4, 5, 6, 9, 16, 17};
  if (who == personality::plane)
    return {0, 2, 5, 6, 7, 10, 11, 12, 1, 13, 15};
  return {0, 4, 10, 11};
}

// Into which an order of godwit's may lead: a person who takes one of these while an order is under way can not be told
// from it.
bool may_be_ours(personality who, std::uint32_t mode) {
  const std::vector<std::uint32_t> ours = who == personality::px4
                                              ? std::vector<std::uint32_t>{px4(4, 3), px4(4, 4), px4(4, 5)}
                                          : who == personality::ardupilot ? std::vector<std::uint32_t>{3, 4, 5, 6, 17}
                                          : who == personality::plane     ? std::vector<std::uint32_t>{5, 10, 11, 12}
                                                                          : std::vector<std::uint32_t>{4, 10, 11};
  return std::ranges::find(ours, mode) != ours.end();
}

mission::document any_mission(personality who, std::mt19937_64& test_rng) {
  auto result = tests::short_mission(who);
  if (who == personality::rover)
    return result;
  const auto variant = test_rng() % 3;
  if (variant == 1)
    result.items.pop_back(); // it ends in the air
  if (variant == 2 && who != personality::plane)
    result.items = tests::with_landing_on_the_way().items;
  return result;
}

class flight_with_people {
public:
  explicit flight_with_people(std::uint64_t seed)
      : test_rng_(seed), who_(static_cast<personality>(test_rng_() % 4)), mission_(any_mission(who_, test_rng_)),
        world_(any_world(test_rng_, who_)), may_start_(is_automatic_) {}

  void fly() {
    world_.load(mission_);
    const auto deeds = 1 + test_rng_() % most_deeds;
    for (std::size_t i = 0; i < deeds && violation_.empty(); ++i) {
      wait(any_while());
      if (i == edge_deed_)
        take_over_at_edge();
      else if (violation_.empty())
        do_something();
    }
    wait(30);
  }

  [[nodiscard]] std::string violation() const {
    return violation_.empty() ? "" : violation_ + "\n" + did_ + world_.story();
  }
  [[nodiscard]] bool had_takeover_at_an_edge() const { return edges_ > 0; }
  [[nodiscard]] bool had_takeover() const { return takeovers_ > 0; }

private:
  flight_world::options any_world(std::mt19937_64& test_rng, personality who) {
    flight_world::options result{.who = who, .arm_on_start = true, .speed = 4};
    is_automatic_ = test_rng() % 2 == 0;
    result.start = is_automatic_ ? start_policy::automatic : start_policy::on_command;
    result.seed = test_rng();
    if (test_rng() % 2 == 0) {
      result.lost = 0.01 * static_cast<double>(test_rng() % 21);
      result.doubled = 0.01 * static_cast<double>(test_rng() % 6);
      result.most_delay_ms = 1 + static_cast<std::int64_t>(test_rng() % 90);
      result.late = 0.002 * static_cast<double>(test_rng() % 6);
    }
    return result;
  }

  // Often short: between two steps of a start lie tenths of a second.
  double any_while() {
    switch (test_rng_() % 3) {
    case 0:
      return 0.05 * static_cast<double>(test_rng_() % 20);
    case 1:
      return 0.2 * static_cast<double>(test_rng_() % 25);
    default:
      return static_cast<double>(test_rng_() % 25);
    }
  }

  void wait(double seconds) {
    for (double left = seconds; left > 0 && violation_.empty(); left -= step_s) {
      world_.run_for(step_s);
      observe();
    }
  }

  void note(const std::string& what) { did_ += std::to_string(world_.now_ns() / 1'000'000) + " ms: " + what + "\n"; }

  // -- what people, lines and computers do

  void do_something() {
    switch (test_rng_() % 16) {
    case 0:
    case 1:
    case 2:
    case 3:
      return change_mode();
    case 4:
      note("armed by hand");
      world_.arm_by_hand();
      touched_ = true;
      return;
    case 5:
      if (test_rng_() % 3 == 0) {
        note("disarmed by hand");
        world_.disarm_by_hand();
        touched_ = true;
      }
      return;
    case 6:
    case 7:
      return say(command_kind::hand_back);
    case 8:
      return say(command_kind::resume);
    case 9:
    case 10:
      return say(command_kind::start);
    case 11:
      return say(std::array{command_kind::pause, command_kind::come_home}[test_rng_() % 2]);
    case 12:
      return assign();
    case 13: {
      constexpr std::array<std::uint16_t, 3> commands{176, 300, 400};
      note("a command is lost");
      return world_.lose_command(commands[test_rng_() % commands.size()], 1 + static_cast<int>(test_rng_() % 3));
    }
    case 14:
      return die();
    default:
      if (test_rng_() % 2 == 0) {
        note("low battery");
        world_.vehicle().set_battery(3 + static_cast<double>(test_rng_() % 20), world_.now_ns());
      } else {
        note("silence");
        world_.cut_line(0.1 * static_cast<double>(test_rng_() % 60));
      }
    }
  }

  // PX4 goes into the mode by itself after a plan.
  [[nodiscard]] bool is_near_plan_end() const {
    const auto& s = world_.durable();
    return s.progress.plan && (s.progress.plan->generation.is_finished || progress::is_at_last_movement(s.progress) ||
                               s.status.now == phase::landing);
  }

  [[nodiscard]] bool is_at_edge() const {
    const auto& s = world_.durable();
    return (s.doing && s.doing->kind == task_kind::start) || (s.status.in_flight && is_near_plan_end());
  }

  // In a start, or on the last leg: waits until it comes, and a little longer.
  void take_over_at_edge() {
    for (int i = 0; i < 1'200 && violation_.empty() && !is_at_edge(); ++i)
      wait(2 * step_s);
    wait(step_s * static_cast<double>(test_rng_() % 30));
    if (violation_.empty())
      change_mode();
  }

  void change_mode() {
    const auto modes = modes_of(who_);
    const auto mode = modes[test_rng_() % modes.size()];
    const auto& s = world_.durable();
    const bool is_starting = s.doing && s.doing->kind == task_kind::start;
    const bool had_watch = is_watched() && (is_starting || world_.vehicle().describe().armed);
    const auto before = world_.vehicle().describe().mode;
    const bool is_plain = !may_be_ours(who_, mode) || (!s.doing && !is_near_plan_end() && !is_reacting() &&
                                                       world_.now_ns() - last_sent_ns_ > order_counts_ns);
    note("mode " + std::to_string(mode) + " by hand");
    world_.switch_mode(mode);
    touched_ = true;
    if (last_heard_ == mode)
      person_mode_.reset(); // put back before anybody has heard of it
    else if (had_watch && is_plain && world_.vehicle().describe().mode != before) {
      person_mode_ = mode;
      orders_before_.reset();
      sent_at_change_ = sent();
      is_edge_ = is_near_plan_end() || (s.doing && s.doing->kind == task_kind::start);
    }
  }

  void say(command_kind what) {
    const auto answer = world_.say(what);
    note(std::string(io::name_of(what)) + (answer.is_taken ? "" : ": refused, " + answer.reason));
    if (!answer.is_taken)
      return;
    if (what == command_kind::hand_back) {
      person_mode_.reset();
      orders_before_.reset();
    }
    const bool is_brought_home = what == command_kind::come_home && who_ == personality::rover; // by a plan of its own
    if (what == command_kind::start || is_brought_home)
      may_start_ = true;
  }

  void assign() {
    const auto& s = world_.durable();
    if (!s.mission || !violation_.empty())
      return;
    note("an assignment");
    mission::assignment assignment;
    assignment.assignment_id = "11111111-2222-4333-8444-" + std::to_string(100'000'000'000 + ++assignments_);
    assignment.base_revision = s.mission->revision;
    assignment.revision = s.mission->revision + 1;
    assignment.replace_after_item_id = test_rng_() % 2 == 0 ? "w1" : "w2";
    assignment.items = {tests::place(who_, "n" + std::to_string(assignments_), 20, 20)};
    if (who_ != personality::rover)
      assignment.items.push_back(tests::way_home(who_));
    world_.assign(assignment);
  }

  void die() {
    switch (test_rng_() % 3) {
    case 0:
      note("the executor dies");
      return world_.crash();
    case 1:
      note("the failsafe dies");
      return world_.crash_failsafe();
    default:
      note("godwit dies");
      return world_.crash_all();
    }
  }

  // -- what is seen

  [[nodiscard]] bool is_watched() const {
    const auto& s = world_.durable();
    return s.status.in_flight || (s.doing && s.doing->kind == task_kind::start);
  }
  [[nodiscard]] bool is_reacting() const {
    return !world_.reactions().empty() && world_.durable().status.cause != pause_cause::taken_over;
  }

  [[nodiscard]] std::size_t sent() const {
    return static_cast<std::size_t>(world_.orders()) + world_.reactions().size();
  }

  void observe() {
    if (sent() != last_sent_)
      last_sent_ns_ = world_.now_ns();
    last_sent_ = sent();
    if (const auto heard = world_.heard_mode())
      last_heard_ = heard;
    watch_track();
    watch_takeover();
    watch_starts();
    watch_reports();
  }

  void watch_takeover() {
    const auto sent = this->sent();
    if (person_mode_ && !orders_before_ && world_.heard_mode() == person_mode_) {
      if (!is_watched() && !needs_hand_back(world_.durable().status.cause)) {
        person_mode_.reset(); // it was over before
        return;
      }
      if (may_be_ours(who_, *person_mode_) && (world_.durable().doing || sent != sent_at_change_)) {
        person_mode_.reset(); // an order into the same mode went out before it was heard: nobody can tell them apart
        return;
      }
      orders_before_ = sent;
      ++takeovers_;
      edges_ += is_edge_ ? 1 : 0;
    }
    if (orders_before_ && sent != *orders_before_)
      violation_ = "something was sent after a takeover that was heard";
  }

  void watch_starts() {
    const auto& s = world_.durable();
    const auto starts = std::ranges::count(world_.commands(), start_command);
    const bool flies_on = who_ == personality::rover && was_in_flight_; // takes a new plan with a start
    if (starts > starts_ && !may_start_ && !flies_on && violation_.empty())
      violation_ = "it was started, and nobody had said so";
    starts_ = starts;
    const bool has_ended = was_in_flight_ && !s.status.in_flight;
    if (has_ended || (s.status.now == phase::paused && s.status.cause != pause_cause::asked && !s.status.in_flight))
      may_start_ = false;
    was_in_flight_ = s.status.in_flight;
  }

  void watch_track() {
    const auto at = world_.vehicle().describe().where;
    here_ = {at.latitude_deg, at.longitude_deg};
    if (!world_.durable().mission)
      return;
    const auto& home = *world_.durable().mission->return_point;
    if (!world_.vehicle().describe().in_air && distance_to(home.latitude, home.longitude) <= home_within())
      at_home_ns_ = world_.now_ns();
    for (const auto& each : world_.durable().mission->items)
      if (const auto* place = std::get_if<mission::waypoint>(&each))
        places_[place->id] = {place->at.latitude, place->at.longitude};
    for (const auto& [id, place] : places_) { // also of earlier revisions: their plan may still be flown
      auto [entry, is_new] = nearest_m_.emplace(id, 1e9);
      entry->second = std::min(entry->second, geo::distance_m(here_, place));
    }
  }

  [[nodiscard]] double distance_to(double latitude, double longitude) const {
    return geo::distance_m(here_, geo::point{latitude, longitude});
  }

  void watch_reports() {
    for (; judged_ < world_.reports().size() && violation_.empty(); ++judged_) {
      const auto& each = world_.reports()[judged_];
      const auto place = nearest_m_.find(each.item_id.value_or(""));
      if (each.kind == progress_kind::reached && !each.inferred && place != nearest_m_.end() &&
          place->second > reached_within())
        violation_ = each.item_id.value_or("") + " is reported as reached, and the vehicle came no nearer than " +
                     std::to_string(place->second) + " m";
      if (each.kind == progress_kind::complete && each.revision == world_.durable().mission->revision)
        judge_complete();
    }
  }

  [[nodiscard]] double reached_within() const {
    return who_ == personality::plane ? plane_reached_within_m : reached_within_m;
  }

  [[nodiscard]] double home_within() const { return who_ == personality::plane ? plane_home_within_m : home_within_m; }

  void judge_complete() {
    const auto& s = world_.durable();
    const auto& last = s.mission->items.back();
    const bool ends_at_home = std::holds_alternative<mission::return_home>(last) || mission::id_of(last) == "home";
    if (ends_at_home && who_ != personality::rover && world_.now_ns() - at_home_ns_ > report_takes_ns)
      violation_ = "complete, and it is not at home on the ground";
    if (const auto* place = std::get_if<mission::waypoint>(&last); place && nearest_m_[place->id] > reached_within())
      violation_ = "complete, and it was never at its last item";
  }

  std::mt19937_64 test_rng_;
  personality who_;
  mission::document mission_;
  bool is_automatic_ = false;
  flight_world world_;
  bool may_start_ = false;
  std::size_t edge_deed_ = test_rng_() % 12; // in most flights there is one
  std::string did_;
  std::string violation_;
  std::optional<std::uint32_t> person_mode_; // taken by a person, and not handed back
  std::optional<std::size_t> orders_before_; // when it was heard
  std::size_t sent_at_change_ = 0;
  std::size_t last_sent_ = 0;
  std::int64_t last_sent_ns_ = 0;
  std::optional<std::uint32_t> last_heard_;
  bool is_edge_ = false;
  bool touched_ = false;
  bool was_in_flight_ = false;
  int takeovers_ = 0;
  int edges_ = 0;
  int assignments_ = 0;
  std::ptrdiff_t starts_ = 0;
  std::size_t judged_ = 0;
  geo::point here_;
  std::int64_t at_home_ns_ = 0; // and on the ground, last
  std::map<std::string, geo::point> places_;
  std::map<std::string, double> nearest_m_;
};

#ifdef __SANITIZE_ADDRESS__
constexpr int usual_people_flights = 50;
#else
constexpr int usual_people_flights = 1'000;
#endif

TEST(any_flight, is_safe_for_the_people_beside_it) {
  const auto first = tests::first_seed();
  const int flights = tests::is_full_run() ? 100 * usual_people_flights : usual_people_flights;
  std::cout << flights << " flights from TEST_SEED=" << first << "\n";
  int takeovers = 0;
  int edges = 0;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(flights); ++seed) {
    flight_with_people flight(seed);
    flight.fly();
    takeovers += flight.had_takeover() ? 1 : 0;
    edges += flight.had_takeover_at_an_edge() ? 1 : 0;
    ASSERT_EQ(flight.violation(), "") << "TEST_SEED=" << seed;
  }
  std::cout << takeovers << " with a takeover, " << edges << " of them in a start or on the last leg\n";
  EXPECT_GT(takeovers, flights / 10);
  EXPECT_GT(edges, flights / 20);
}

} // namespace people_property_test
} // namespace godwit::executor
