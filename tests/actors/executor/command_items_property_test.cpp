// Each command of the table at a random place of a mission, on each kind of vehicle, while crashes, kills, pauses and
// changes of the mission come at random: it is taken, flown, and reported as it was. TEST_SEED=n begins with seed n,
// TEST_FULL=1 flies 10,000.
#include <cstdlib>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/executor/command_samples.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/support/run_options.hpp"

namespace godwit::executor {
namespace command_items_property_test {

using command_samples::vehicle_row;
using mission::item_answer;
using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;

// How near the vehicle ever came to each waypoint of a mission.
class nearest_places {
public:
  nearest_places(flight_world& world, const mission::document& mission) : world_(world) {
    for (const auto& each : mission.items)
      if (const auto* waypoint = std::get_if<mission::waypoint>(&each))
        places_.push_back({waypoint->id, {waypoint->at.latitude, waypoint->at.longitude}});
  }
  void look() {
    const auto at = world_.vehicle().describe().where;
    for (auto& each : places_)
      each.nearest_m =
          std::min(each.nearest_m, geo::distance_m(geo::point{at.latitude_deg, at.longitude_deg}, each.at));
  }
  // Reached, or so it was reported, and farther away than that: its id.
  [[nodiscard]] std::string missed(double metres) const {
    for (const auto& report : world_.reports())
      for (const auto& each : places_)
        if (report.kind == progress_kind::reached && report.item_id == each.id && each.nearest_m > metres)
          return each.id;
    return {};
  }

private:
  struct place {
    std::string id;
    geo::point at;
    double nearest_m = std::numeric_limits<double>::max();
  };
  flight_world& world_;
  std::vector<place> places_;
};

class disturbed_flight {
  template <class Range>
  const auto& one_of(const Range& range) {
    return range[static_cast<std::size_t>(number(0, static_cast<int>(std::size(range)) - 1))];
  }

public:
  explicit disturbed_flight(std::uint64_t seed)
      : random_(seed), vehicle_(one_of(command_samples::vehicles)), row_(*one_of(rows())), mission_(with_sample()),
        world_({.who = vehicle_.who, .seed = seed, .has_payload = seed % 2 == 0}), places_(world_, mission_) {}

  testing::AssertionResult fly() {
    world_.load(mission_);
    if (row_.answer_of(vehicle_.planned) == item_answer::refused) {
      if (world_.run_until_phase(phase::flying, 20) || world_.vehicle().mission_items().size() > 1)
        return failure("it is brought, and the vehicle refuses it");
      return testing::AssertionSuccess();
    }
    if (!world_.run_until_phase(phase::flying, 60))
      return failure("it does not begin");
    for (auto left = number(0, 3); left > 0 && !fly_for(seconds(0, 25)); --left)
      if (is_between_ground_and_landing())
        disturb();
    if (!fly_for(1500))
      return failure("it does not end");
    if (const auto id = places_.missed(vehicle_.who == personality::plane ? 150 : 20); !id.empty())
      return failure(id + " is reported as reached, and the vehicle was never near it");
    const auto told = command_samples::tells_the_truth(world_, mission_, {{"x", end_of(row_, vehicle_)}});
    return told ? told : failure(told.message());
  }

private:
  static const std::vector<const mission::command_row*>& rows() {
    static const auto all = command_samples::rows_flown_on_from();
    return all;
  }
  int number(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double seconds(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  // After the take-off, and before the return.
  mission::document with_sample() {
    const auto plain = tests::short_mission(vehicle_.who);
    const auto last = static_cast<int>(plain.items.size()) - (sim::drives(vehicle_.who) ? 0 : 1);
    const auto at = static_cast<std::size_t>(number(sim::drives(vehicle_.who) ? 0 : 1, last));
    return command_samples::mission_with(vehicle_.who, at, {command_samples::sample_of(row_, vehicle_.who)});
  }

  bool fly_for(double wanted_s) {
    return world_.run_until(
        [&] {
          places_.look();
          return world_.durable().status.now == phase::done;
        },
        wanted_s);
  }

  // What is stopped on the ground, or called away from its landing, waits there for a person.
  [[nodiscard]] bool is_between_ground_and_landing() {
    return (sim::drives(vehicle_.who) || world_.vehicle().describe().in_air) &&
           !tests::is_told(world_, progress_kind::started, mission::id_of(mission_.items.back()));
  }

  void disturb() {
    switch (number(0, 3)) {
    case 0:
      did_ += " crash";
      world_.crash();
      break;
    case 1:
      did_ += " kill";
      world_.crash_all();
      break;
    case 2:
      did_ += " pause";
      if (!world_.say(command_kind::pause).is_taken)
        break;
      static_cast<void>(fly_for(seconds(1, 8)));
      did_ += world_.say(command_kind::resume).is_taken ? " resume" : " -";
      break;
    default:
      change();
    }
  }

  // Away from the mission, and back to it. A plane circles far from its line, and is left alone.
  void change() {
    if (vehicle_.who == personality::plane)
      return;
    did_ += " goto";
    operators::command there;
    there.kind = command_kind::go_to;
    there.place = std::get<mission::waypoint>(tests::place(vehicle_.who, "there", 20, 20)).at;
    if (!world_.say(there).is_taken)
      return;
    static_cast<void>(fly_for(seconds(4, 15)));
    did_ += world_.say(command_kind::cancel).is_taken ? " cancel" : " -";
  }

  testing::AssertionResult failure(const std::string& what) {
    return testing::AssertionFailure() << io::name_of(vehicle_.who) << ' ' << row_.name << did_ << ": " << what << '\n'
                                       << world_.story();
  }

  std::mt19937_64 random_;
  const vehicle_row& vehicle_;
  const mission::command_row& row_;
  mission::document mission_;
  flight_world world_;
  nearest_places places_;
  std::string did_;
};

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t usual_flights = 60; // each takes many times as long
#else
constexpr std::uint64_t usual_flights = 600;
#endif

TEST(command_items_property, a_command_anywhere_is_flown_and_reported_as_it_was_whatever_happens) {
  const auto first = tests::first_seed();
  const std::uint64_t flights = tests::is_full_run() ? 10'000 : usual_flights;
  int failed = 0;
  for (auto seed = first; seed < first + flights && failed < 5; ++seed) {
    const auto flown = disturbed_flight(seed).fly();
    failed += flown ? 0 : 1;
    EXPECT_TRUE(flown) << "seed " << seed;
  }
}

} // namespace command_items_property_test
} // namespace godwit::executor
