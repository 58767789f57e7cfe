#include "actors/executor/plan/plan_writer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::plan {

namespace {

// A circle is looked at as a polygon around it: 2 % wider at its corners, which is on the safe side.
constexpr int chords = 16;

std::uint16_t sequence_of(std::size_t index) { return static_cast<std::uint16_t>(index); }

bool is_speed(const mission_item_int& item) {
  return item.command == io::mavlink::number(io::mavlink::mav_cmd::do_change_speed);
}

// Speeds behind the last movement: nothing is flown with them.
void drop_idle_commands(flight_plan& plan) {
  while (!plan.items.empty() && is_speed(plan.items.back())) {
    plan.items.pop_back();
    const auto owner = std::find_if(plan.map.items.rbegin(), plan.map.items.rend(),
                                    [](const progress::mapped_item& each) { return each.sequence_count > 0; });
    GODWIT_ASSERT(owner != plan.map.items.rend(), "plan: each vehicle item belongs to an item of the mission");
    --owner->sequence_count;
  }
  for (auto& each : plan.map.items)
    each.first_sequence = std::min(each.first_sequence, sequence_of(plan.items.size()));
}

} // namespace

plan_writer::plan_writer(const plan_setting& setting, const mission::position& start, bool is_under_way,
                         std::optional<double> speed_mps)
    : setting_(setting), start_(start), here_(start), began_under_way_(is_under_way), is_in_air_(is_under_way),
      owes_speed_(speed_mps.has_value()), speed_mps_(speed_mps) {
  if (keeps_home_as_item(setting))
    plan_.items.push_back(home_item(setting));
  plan_.map.first_sequence = sequence_of(plan_.items.size());
  plan_.map.start_sequence = plan_.map.first_sequence;
  if (sets_home_in_plan(setting) && !is_under_way)
    plan_.items.push_back(set_home_item(setting));
  for (std::size_t i = 0; i < plan_.items.size(); ++i)
    plan_.items[i].seq = sequence_of(i);
}

void plan_writer::begin_item(const std::string& id, std::uint32_t index) {
  plan_.map.items.push_back({id, index, sequence_of(plan_.items.size()), 0, std::nullopt, std::nullopt});
}

void plan_writer::append(const mission_item_int& item) {
  GODWIT_ASSERT(!plan_.map.items.empty(), "plan: a vehicle item belongs to an item of the mission");
  auto& owner = plan_.map.items.back();
  const auto sequence = sequence_of(plan_.items.size());
  plan_.items.push_back(item);
  plan_.items.back().seq = sequence;
  ++owner.sequence_count;
  if (!is_nav(item))
    return;
  owner.last_nav_sequence = sequence;
  if (!owner.first_nav_sequence)
    owner.first_nav_sequence = sequence;
  ++navs_;
}

void plan_writer::set_speed(double mps) {
  speed_mps_ = mps;
  owes_speed_ = false;
  append(speed_item(mps, setting_));
}

void plan_writer::pay_speed() {
  if (owes_speed_)
    set_speed(*speed_mps_);
}

void plan_writer::add_take_off(const mission_item_int& item) {
  append(item);
  is_in_air_ = true;
}

void plan_writer::add_nav(const mission_item_int& item) {
  pay_speed();
  append(item);
}

void plan_writer::mark_landing() {
  plan_.landing_sequence = sequence_of(plan_.items.size());
  append(landing_start_item());
}

void plan_writer::begin_survey(std::uint32_t lines_before) {
  pay_speed();
  plan_.surveys.push_back({plan_.map.items.back().item_index, lines_before, sequence_of(plan_.items.size()), 0});
}

void plan_writer::end_survey() {
  auto& survey = plan_.surveys.back();
  survey.line_count = static_cast<std::uint16_t>((plan_.items.size() - survey.first_line_sequence) / 2);
}

void plan_writer::go(leg_kind kind, const mission::position& to) {
  plan_.legs.push_back({kind, here_, to, plan_.map.items.back().item_index});
  here_ = to;
}

void plan_writer::climb_to(double altitude_m) {
  if (altitude_m > here_.altitude_m)
    go(is_in_air_ ? leg_kind::cruise : leg_kind::climb, {here_.latitude, here_.longitude, altitude_m});
}

void plan_writer::cruise_to(const mission::position& to) {
  go(leg_kind::cruise, to);
  comes_from_a_place_ = true;
}

void plan_writer::circle(double radius_m) {
  const auto centre = here_;
  const double corner_m = std::abs(radius_m) / std::cos(std::numbers::pi / chords);
  const auto corner = [&](int i) -> mission::position {
    const auto at = geo::destination({centre.latitude, centre.longitude}, 360.0 * i / chords, corner_m);
    return {at.latitude_deg, at.longitude_deg, centre.altitude_m};
  };
  here_ = corner(0);
  for (int i = 1; i <= chords; ++i)
    go(leg_kind::circle, corner(i % chords));
  here_ = centre;
}

void plan_writer::descend_to(const mission::position& to) {
  go(leg_kind::descent, to);
  is_in_air_ = false;
  ends_on_ground_ = true;
}

void plan_writer::take_over(const progress::plan_map& idle) {
  for (auto each : idle.items) {
    each.first_sequence = sequence_of(plan_.items.size());
    each.sequence_count = 0;
    plan_.map.items.push_back(std::move(each));
  }
}

flight_plan plan_writer::finished() const {
  GODWIT_ASSERT(has_moved(), "plan: a plan moves the vehicle");
  auto plan = plan_;
  drop_idle_commands(plan);
  plan.items.at(plan.map.start_sequence).current = 1;
  plan.map.total = sequence_of(plan.items.size() - plan.map.first_sequence);
  plan.ends_at = here_;
  plan.ends_on_ground = ends_on_ground_;
  GODWIT_ASSERT(progress::is_sound(plan.map), "plan: the map is total and runs in order");
  return plan;
}

} // namespace godwit::executor::plan
