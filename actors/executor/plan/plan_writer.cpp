#include "actors/executor/plan/plan_writer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "actors/executor/progress/acts.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::plan {

namespace {

// A circle is looked at as a polygon around it: 2 % wider at its corners, which is on the safe side.
constexpr int chords = 16;

std::uint16_t sequence_of(std::size_t index) { return static_cast<std::uint16_t>(index); }

bool is_speed(const mission_item_int& item) {
  return item.command == io::mavlink::number(io::mavlink::mav_cmd::do_change_speed);
}

// So long at most a condition holds the commands after it back.
double held_back_by(const mission_item_int& item) {
  using io::mavlink::mav_cmd;
  constexpr double until_next_place_s = 86'400;
  switch (static_cast<mav_cmd>(item.command)) {
  case mav_cmd::condition_delay:
    return std::clamp(static_cast<double>(item.param1), 0.0, until_next_place_s);
  case mav_cmd::condition_distance:
  case mav_cmd::condition_yaw:
    return until_next_place_s;
  default:
    return 0;
  }
}

// Speeds after the last movement: nothing is flown with them. What came verbatim stays.
void drop_idle_commands(flight_plan& plan) {
  while (!plan.items.empty() && is_speed(plan.items.back())) {
    const auto owner = std::find_if(plan.map.items.rbegin(), plan.map.items.rend(),
                                    [](const progress::mapped_item& each) { return each.sequence_count > 0; });
    GODWIT_ASSERT(owner != plan.map.items.rend(), "plan: each vehicle item belongs to an item of the mission");
    if (owner->role != progress::item_role::flown)
      break;
    plan.items.pop_back();
    --owner->sequence_count;
  }
  for (auto& each : plan.map.items)
    each.first_sequence = std::min(each.first_sequence, sequence_of(plan.items.size()));
}

// After the last movement ArduPilot executes the first command alone.
void leave_out_late_acts(progress::plan_map& map) {
  bool has_one = false;
  for (auto i = progress::items_to_finish(map); i < map.items.size(); ++i)
    if (auto& each = map.items[i]; each.role == progress::item_role::acts && each.sequence_count > 0)
      if (std::exchange(has_one, true))
        each.role = progress::item_role::unflown;
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
  if (setting.stops_camera && is_under_way)
    plan_.items.push_back(*setting.stops_camera);
  for (std::size_t i = 0; i < plan_.items.size(); ++i)
    plan_.items[i].seq = sequence_of(i);
}

void plan_writer::begin_item(const std::string& id, std::uint32_t index) {
  plan_.map.items.push_back({id, index, sequence_of(plan_.items.size()), 0, std::nullopt, std::nullopt});
  if (is_branch_)
    plan_.map.items.back().role = progress::item_role::unflown;
}

void plan_writer::append(const mission_item_int& item) {
  const auto sequence = sequence_of(plan_.items.size());
  plan_.items.push_back(item);
  plan_.items.back().seq = sequence;
  if (const auto change = trigger_change_of(item)) {
    if (change->how == trigger_change::by::distance)
      trigger_by_distance(change->value, item.param3 == 1);
    else
      is_triggering_ = change->value > 0;
  }
  if (plan_.map.items.empty())
    return; // of the lead-in
  auto& owner = plan_.map.items.back();
  ++owner.sequence_count;
  if (owner.role != progress::item_role::unflown && trigger_m_ == 0 && !is_triggering_)
    owner.act = progress::act_of(item, is_ardupilot(setting_));
  held_back_s_ += held_back_by(item);
  owner.act_late_s = owner.act == progress::act_kind::none ? 0 : static_cast<std::uint32_t>(std::ceil(held_back_s_));
  if (!is_nav(item) || owner.role == progress::item_role::unflown)
    return;
  held_back_s_ = 0;
  owner.last_nav_sequence = sequence;
  owner.ends_with_picture = false;
  if (!owner.first_nav_sequence)
    owner.first_nav_sequence = sequence;
  ++navs_;
}

// AT_ONCE: a picture is taken where the vehicle is. With the trigger off that is the last one of the line before it.
void plan_writer::trigger_by_distance(double distance_m, bool at_once) {
  const bool was_on = std::exchange(trigger_m_, distance_m) > 0;
  if (distance_m > 0)
    pictures_at_once_ += at_once ? 1 : 0;
  if (distance_m > 0 || !at_once || !was_on)
    return;
  const auto line = std::find_if(plan_.map.items.rbegin(), plan_.map.items.rend(),
                                 [](const progress::mapped_item& each) { return each.last_nav_sequence.has_value(); });
  if (line == plan_.map.items.rend() || line->pictures == 0)
    return;
  ++line->pictures;
  line->ends_with_picture = true;
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

void plan_writer::add_verbatim(const mission_item_int& item, progress::item_role role) {
  constexpr auto land_start = io::mavlink::number(io::mavlink::mav_cmd::do_land_start);
  auto& owner = plan_.map.items.back();
  owner.role = is_branch_ ? progress::item_role::unflown : role;
  if (item.command == land_start && !plan_.landing_sequence)
    plan_.landing_sequence = sequence_of(plan_.items.size());
  if (owner.role == progress::item_role::flown)
    pay_speed();
  append(item);
}

std::uint32_t plan_writer::item_index() const {
  return plan_.map.items.empty() ? lead_in_item_ : plan_.map.items.back().item_index;
}

// A PX4 whose plan begins with a jump stays at it for ever. It begins at the item that is marked as the current one; an
// ArduPilot begins at the first.
void plan_writer::end_lead_in(const std::string& entry) {
  pay_speed();
  entry_ = loop_entry{.item_id = entry, .jump_sequence = {}};
  lead_in_legs_ = plan_.legs.size();
  skips_leg_ = true;
  if (!is_ardupilot(setting_) && plan_.items.size() == plan_.map.first_sequence)
    return;
  entry_->jump_sequence = sequence_of(plan_.items.size());
  append(jump_item(1));
}

void plan_writer::add_jump(const mission_item_int& item, const std::string& to) {
  jumps_.push_back({sequence_of(plan_.items.size()), plan_.map.items.back().item_index, to, item.param2});
  add_verbatim(item, progress::item_role::acts);
}

void plan_writer::jump_to(const mission::position& to) {
  const auto here = here_;
  const double trigger_m = std::exchange(trigger_m_, 0);
  go(leg_kind::cruise, to);
  here_ = here;
  trigger_m_ = trigger_m;
}

void plan_writer::begin_branch() {
  is_branch_ = true;
  is_in_air_ = true;
  skips_leg_ = true;
  landed_at_ = here_;
}

std::optional<std::string> plan_writer::missing_target() const {
  for (const auto& each : jumps_)
    if (std::ranges::find(plan_.map.items, each.to, &progress::mapped_item::item_id) == plan_.map.items.end())
      return each.to;
  return std::nullopt;
}

void plan_writer::begin_survey(std::uint32_t lines_before, std::uint16_t items_per_line,
                               std::uint16_t items_after_line) {
  pay_speed();
  plan_.surveys.push_back({.item_index = plan_.map.items.back().item_index,
                           .lines_before = lines_before,
                           .first_line_sequence = sequence_of(plan_.items.size()),
                           .items_per_line = items_per_line,
                           .items_after_line = items_after_line});
}

void plan_writer::end_survey() {
  auto& survey = plan_.surveys.back();
  survey.line_count =
      static_cast<std::uint16_t>((plan_.items.size() - survey.first_line_sequence) / survey.items_per_line);
}

void plan_writer::continue_line(const mission::picture_count& before) {
  auto& line = plan_.map.items.back();
  line.pictures += before.taken;
  line.continues_line = true;
}

void plan_writer::go(leg_kind kind, const mission::position& to) {
  if (!std::exchange(skips_leg_, false))
    plan_.legs.push_back({kind, here_, to, item_index()});
  constexpr double most_pictures = 1e6; // of a leg; a trigger by the micrometre is nonsense, and flown all the same
  if (trigger_m_ > 0 && kind == leg_kind::cruise && !plan_.map.items.empty()) {
    auto& line = plan_.map.items.back();
    line.pictures += std::exchange(pictures_at_once_, 0) +
                     static_cast<std::uint32_t>(
                         std::min(most_pictures, geo::distance_m(point_of(here_), point_of(to)) / trigger_m_));
    ++line.lines;
  }
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
  is_in_air_ = is_branch_;
  ends_on_ground_ = true;
}

void plan_writer::take_over(const progress::plan_map& idle) {
  for (auto each : idle.items) {
    each.first_sequence = sequence_of(plan_.items.size());
    each.sequence_count = 0;
    plan_.map.items.push_back(std::move(each));
  }
}

// What belongs to ITEM_INDEX, from the target of a jump up to it, is flown once more each time, and the jump itself as
// often as it is taken; what stands before the item with which the plan begins, once less. Loops within loops multiply,
// which is more than vehicles fly that count each jump once.
double plan_writer::rounds_of(const flight_plan& plan, std::span<const item_loop> loops, std::uint32_t item_index) {
  constexpr double most = 1e6;
  const bool is_before = plan.map.items_before > 0 && item_index < plan.map.items.at(plan.map.items_before).item_index;
  double rounds = 1;
  for (const auto& each : loops)
    if (item_index >= each.first && item_index <= each.jump)
      rounds *= item_index == each.jump ? std::max(each.taken, 1.0) : is_before ? each.taken : each.taken + 1;
  return std::min(most, rounds);
}

void plan_writer::count_rounds(flight_plan& plan, std::span<const item_loop> loops) const {
  for (auto& leg : std::span(plan.legs).subspan(lead_in_legs_))
    leg.times = rounds_of(plan, loops, leg.item_index);
  for (const auto& owner : plan.map.items)
    if (owner.role != progress::item_role::unflown)
      for (int i = 0; i < owner.sequence_count; ++i)
        plan.waits_s += rounds_of(plan, loops, owner.item_index) *
                        wait_of(plan.items.at(static_cast<std::size_t>(owner.first_sequence + i)), setting_);
}

// Of each leg that belongs to an item, by its index.
std::vector<double> plan_writer::leg_lengths() const {
  std::vector<double> lengths_m(plan_.legs.size());
  for (auto i = lead_in_legs_; i < lengths_m.size(); ++i) {
    const auto& leg = plan_.legs[i];
    lengths_m[i] =
        std::hypot(geo::distance_m(point_of(leg.from), point_of(leg.to)), leg.to.altitude_m - leg.from.altitude_m);
  }
  return lengths_m;
}

// No vehicle flies a round of the loop in less.
std::int64_t plan_writer::round_ns(const item_loop& loop, std::span<const double> lengths_m) const {
  const double fastest_mps = setting_.vehicle == flight::vehicle_class::fixed_wing ? 60 : 30;
  double length_m = 0;
  for (auto i = lead_in_legs_; i < lengths_m.size(); ++i)
    if (plan_.legs[i].item_index > loop.first && plan_.legs[i].item_index <= loop.jump)
      length_m += lengths_m[i];
  return static_cast<std::int64_t>(length_m / fastest_mps * 1e9);
}

// Each jump gets the sequence of its target; those that lead back are loops.
void plan_writer::lead_jumps(flight_plan& plan) const {
  std::vector<item_loop> loops;
  const auto lengths_m = jumps_.empty() ? std::vector<double>() : leg_lengths();
  for (const auto& each : jumps_) {
    const auto target = std::ranges::find(plan.map.items, each.to, &progress::mapped_item::item_id);
    GODWIT_ASSERT(target != plan.map.items.end(), "plan: a jump leads to an item of the plan");
    plan.items.at(each.sequence).param1 = target->first_sequence;
    if (target->item_index <= each.item_index)
      loops.push_back({target->item_index, each.item_index, std::max(each.times, 0.0)});
    if (target->first_sequence < each.sequence && each.times != 0)
      plan.map.loops.push_back({.target_sequence = target->first_sequence,
                                .jump_sequence = each.sequence,
                                .round_ns = round_ns({target->item_index, each.item_index, 0}, lengths_m),
                                .counts_anew = is_ardupilot(setting_)});
  }
  count_rounds(plan, loops);
}

void plan_writer::lead_in(flight_plan& plan) const {
  if (!entry_)
    return;
  auto& map = plan.map;
  const auto entry = std::ranges::find(map.items, entry_->item_id, &progress::mapped_item::item_id);
  GODWIT_ASSERT(entry != map.items.end(), "plan: a lead-in leads to an item of the plan");
  map.items_before = static_cast<std::uint32_t>(entry - map.items.begin());
  if (!entry_->jump_sequence) {
    map.start_sequence = entry->first_sequence;
    return;
  }
  plan.items.at(*entry_->jump_sequence).param1 = entry->first_sequence;
  map.enters_at = entry->first_sequence;
}

flight_plan plan_writer::finished() const {
  GODWIT_ASSERT(has_moved(), "plan: a plan moves the vehicle");
  auto plan = plan_;
  drop_idle_commands(plan);
  lead_in(plan);
  plan.items.at(plan.map.start_sequence).current = 1;
  plan.map.total = sequence_of(plan.items.size() - plan.map.first_sequence);
  lead_jumps(plan);
  if (is_ardupilot(setting_))
    leave_out_late_acts(plan.map);
  plan.ends_at = is_branch_ ? landed_at_ : here_;
  plan.ends_on_ground = ends_on_ground_;
  GODWIT_ASSERT(progress::is_sound(plan.map), "plan: the map is total and runs in order");
  return plan;
}

} // namespace godwit::executor::plan
