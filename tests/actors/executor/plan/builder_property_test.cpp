#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/executor/plan/builder.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace builder_property_test {

// Missions that can be flown: each flight begins with a take-off, and ends with a landing or with the mission.
class flyable_mission_maker {
public:
  explicit flyable_mission_maker(std::uint64_t seed) : random_(seed) {}

  mission::document mission() {
    std::vector<mission::item> items;
    for (int flights = whole(1, 3); flights > 0; --flights) {
      items.emplace_back(mission::takeoff{next_id(), number(10, 60)});
      for (int i = whole(0, 5); i > 0; --i)
        items.push_back(any_item());
      items.emplace_back(waypoint(next_id(), place(40)));
      if (flights > 1 || whole(0, 1) == 0)
        items.push_back(whole(0, 2) == 0 ? mission::item(mission::return_home{next_id()})
                                         : mission::land{next_id(), place(0)});
    }
    return mission_of(std::move(items));
  }

  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

private:
  mission::item any_item() {
    switch (whole(0, 3)) {
    case 0:
      return mission::change_speed{next_id(), number(2, 20)};
    case 1:
      return mission::loiter{next_id(), place(40), 0, number(0, 100)};
    case 2:
      return survey_of(next_id(), tests::star(random_, {number(-900, 900), number(-900, 900)}, 60, 300),
                       number(20, 80));
    default:
      return mission::waypoint{next_id(), place(40), number(0, 9), 0,
                               whole(0, 1) == 0 ? std::nullopt : std::optional(number(2, 20))};
    }
  }

  mission::position place(double altitude_m) {
    const double east_m = number(-900, 900);
    return at(east_m, number(-900, 900), altitude_m);
  }
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::string next_id() { return "i" + std::to_string(++count_); }

  std::mt19937_64 random_;
  int count_ = 0;
};

plan_setting any_setting(flyable_mission_maker& make) {
  const std::vector<plan_setting> settings{px4_copter, ardupilot_copter, rover,
                                           setting_of(vehicle_class::rover, mav_autopilot::ardupilotmega)};
  return settings.at(static_cast<std::size_t>(make.whole(0, 3)));
}

std::vector<flight_plan> planned(const mission::document& mission, const plan_setting& setting) {
  auto plans = build_plans(mission, setting);
  if (!plans)
    RC_FAIL(plans.error().message());
  return *std::move(plans);
}

void expect_total_and_monotone(const flight_plan& plan) {
  std::vector<int> owners(plan.items.size(), 0);
  int sequence = plan.map.first_sequence;
  for (const auto& each : plan.map.items) {
    RC_ASSERT(each.first_sequence == sequence);
    for (int i = 0; i < each.sequence_count; ++i)
      ++owners.at(static_cast<std::size_t>(sequence++));
  }
  for (std::size_t i = 0; i < owners.size(); ++i)
    RC_ASSERT(owners[i] == (i < plan.map.first_sequence ? 0 : 1));
  RC_ASSERT(sequence == progress::end_sequence(plan.map));
}

RC_GTEST_PROP(builder_property, each_vehicle_item_belongs_to_one_item_of_the_mission_in_the_same_order, ()) {
  flyable_mission_maker make(*rc::gen::arbitrary<std::uint64_t>());
  const auto mission = make.mission();
  const auto setting = any_setting(make);
  const auto plans = planned(mission, setting);
  std::uint32_t index = 0;
  for (const auto& plan : plans) {
    expect_total_and_monotone(plan);
    RC_ASSERT(progress::is_sound(plan.map));
    for (const auto& each : plan.map.items) {
      RC_ASSERT(each.item_index == index);
      RC_ASSERT(each.item_id == mission::id_of(mission.items[index]));
      ++index;
    }
    RC_ASSERT(plan.map.ends_mission == (&plan == &plans.back()));
  }
  RC_ASSERT(index == mission.items.size());
}

RC_GTEST_PROP(builder_property, sequences_count_from_0_and_one_item_is_marked, ()) {
  flyable_mission_maker make(*rc::gen::arbitrary<std::uint64_t>());
  const auto mission = make.mission();
  const auto plans = planned(mission, any_setting(make));
  for (const auto& plan : plans) {
    for (std::size_t i = 0; i < plan.items.size(); ++i) {
      RC_ASSERT(plan.items[i].seq == i);
      RC_ASSERT((plan.items[i].current == 1) == (i == plan.map.start_sequence));
    }
    RC_ASSERT(plan.items.size() <= max_plan_items);
  }
}

RC_GTEST_PROP(builder_property, every_movement_has_its_way_and_the_ways_join, ()) {
  flyable_mission_maker make(*rc::gen::arbitrary<std::uint64_t>());
  const auto mission = make.mission();
  const auto plans = planned(mission, any_setting(make));
  const mission::position* before = nullptr;
  for (const auto& plan : plans)
    for (const auto& each : plan.legs) {
      RC_ASSERT((before == nullptr || *before == each.from));
      before = &each.to;
    }
}

std::string text_of(const io::mavlink::mission_item_int& item) {
  return std::to_string(item.command) + ' ' + std::to_string(item.x) + ' ' + std::to_string(item.y) + ' ' +
         std::to_string(item.z);
}

// What moves the vehicle for the items from INDEX on. A speed that is said again is none of it, and a return is the
// same whether it is said in places or left to the vehicle: that depends on where home is known to be.
std::vector<std::string> movements_from(const mission::document& mission, const std::vector<flight_plan>& plans,
                                        std::size_t index) {
  std::vector<std::string> movements;
  for (const auto& plan : plans)
    for (const auto& each : plan.map.items) {
      if (each.item_index < index || !each.first_nav_sequence)
        continue;
      if (std::holds_alternative<mission::return_home>(mission.items.at(each.item_index))) {
        movements.push_back(each.item_id + ": return");
        continue;
      }
      for (std::size_t i = 0; i < each.sequence_count; ++i) {
        const auto& item = plan.items.at(each.first_sequence + i);
        if (is_nav(item))
          movements.push_back(each.item_id + ": " + text_of(item));
      }
    }
  return movements;
}

// The vehicle is about to begin item INDEX: on the ground where a plan begins with it, else somewhere on its way. Home
// has moved to where it took off last.
plan_setting before_item(std::size_t index, const std::vector<flight_plan>& plans, plan_setting setting) {
  setting.is_under_way = true;
  for (const auto& plan : plans) {
    const auto first = plan.map.items.front().item_index;
    if (first > index)
      break;
    const auto& start = plan.legs.front().from;
    setting.home.latitude = start.latitude;
    setting.home.longitude = start.longitude;
    setting.is_under_way = first != index;
    setting.start = setting.is_under_way ? at(50, 50, 40) : start;
  }
  return setting;
}

RC_GTEST_PROP(builder_property, the_rest_of_a_mission_flies_the_same_movements_in_the_same_order, ()) {
  flyable_mission_maker make(*rc::gen::arbitrary<std::uint64_t>());
  const auto mission = make.mission();
  const auto setting = any_setting(make);
  const auto whole = planned(mission, setting);
  const auto from = static_cast<std::size_t>(make.whole(0, static_cast<int>(mission.items.size()) - 1));
  const auto rest = build_plans(mission, before_item(from, whole, setting), {from, 0});
  if (rest)
    RC_ASSERT(movements_from(mission, *rest, 0) == movements_from(mission, whole, from));
  else
    RC_ASSERT((rest.error().code == plan_errc::nothing_to_fly && movements_from(mission, whole, from).empty()));
}

// The speed that each movement is flown with.
std::vector<std::pair<std::uint32_t, float>> speeds_of(const std::vector<flight_plan>& plans) {
  std::vector<std::pair<std::uint32_t, float>> speeds;
  for (const auto& plan : plans) {
    float speed = 0; // a vehicle forgets it with each plan
    for (const auto& each : plan.map.items)
      for (std::size_t i = 0; i < each.sequence_count; ++i) {
        const auto& item = plan.items.at(each.first_sequence + i);
        if (item.command == 178)
          speed = item.param2;
        else if (item.command != 22)
          speeds.emplace_back(each.item_index, speed);
      }
  }
  return speeds;
}

RC_GTEST_PROP(builder_property, each_movement_is_flown_with_the_speed_that_was_asked_for_last, ()) {
  flyable_mission_maker make(*rc::gen::arbitrary<std::uint64_t>());
  const auto mission = make.mission();
  const auto plans = planned(mission, any_setting(make));
  for (const auto& [index, speed] : speeds_of(plans)) {
    std::optional<double> wanted_mps;
    for (std::size_t i = 0; i <= index; ++i) {
      if (const auto* change = std::get_if<mission::change_speed>(&mission.items[i]))
        wanted_mps = change->mps;
      if (const auto* w = std::get_if<mission::waypoint>(&mission.items[i]); w != nullptr && w->speed_mps)
        wanted_mps = w->speed_mps;
    }
    RC_ASSERT(speed == static_cast<float>(wanted_mps.value_or(0)));
  }
}

} // namespace builder_property_test
} // namespace godwit::executor::plan
