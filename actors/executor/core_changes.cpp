// What operators change in flight: go there, cancel, insert. The service numbers the revision; where there is none, we
// do. And what becomes of a revision that comes in flight, whoever asked for it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/route/route.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/executor/core.hpp"
#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/remaining.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using operator_words::verb;

constexpr std::uint64_t changes = 0x6368616e6765; // keeps their keys apart from whatever else follows from a mission

// A vehicle turns to the next leg before it has reached the end of this one. PX4 does so within the radius of the item,
// an ArduPilot multirotor or rover within its own of 2 m (WP_RADIUS); wind and control add to it.
constexpr double turn_accept_radius_m = 2;
constexpr double turn_room_m = 5;

constexpr double lowest_m = 1; // what flies is sent above home

operator_words::answer refused(std::string why) { return {false, std::move(why)}; }

std::string_view reason_for(change_kind kind) {
  switch (kind) {
  case change_kind::go_to:
    return "an operator sent the vehicle elsewhere";
  case change_kind::cancel:
    return "an operator sent the vehicle back to its mission";
  case change_kind::insert:
    break;
  }
  return "an operator inserted a waypoint";
}

} // namespace

// -- a word -----------------------------------------------------------------------------------------

operator_words::answer core::take_change(const operator_words::word& m, instant now) {
  if (!may_change_plan() || !s_.mission)
    return refused("the mission can not be changed now: " + sentence());
  if (s_.change || wanted_change_ || runner_.is_busy() || !s_.waiting.empty() || s_.arrived)
    return refused("another change is under way; say it again when it is over");
  if (m.verb != verb::cancel && !m.place)
    return refused("the word has no place");
  if (m.verb != verb::cancel)
    if (auto why = why_not_there(*m.place); !why.empty())
      return refused(std::move(why));
  auto wish = m.verb == verb::go_to    ? wish_to_go(*m.place, now)
              : m.verb == verb::cancel ? wish_to_cancel()
                                       : wish_to_insert(m);
  if (!wish)
    return refused(std::move(wish.error()));
  if (auto why = why_not_changed(*wish, now); !why.empty())
    return refused(std::move(why));
  wanted_change_ = *std::move(wish);
  wanted_.reset(); // the last word counts
  return {true, {}};
}

// Empty: a place like those of a mission, within the limits that are set.
std::string core::why_not_there(const mission::position& to) const {
  const geo::point there{to.latitude, to.longitude};
  if (!geo::is_valid(there) || !std::isfinite(to.altitude_m))
    return "the place is none: latitude -90 to 90, longitude -180 to 180, altitude in metres above home";
  const bool drives = view_.owner().vehicle == flight::vehicle_class::rover;
  if (to.altitude_m > settings_.max_altitude_m || (!drives && to.altitude_m < lowest_m))
    return "the altitude has to be between " + std::to_string(static_cast<int>(lowest_m)) + " and " +
           std::to_string(static_cast<int>(settings_.max_altitude_m)) + " m above home (flight.max_altitude_m)";
  if (!view_.home())
    return "the vehicle has told no home yet";
  const auto away_m = geo::distance_m({view_.home()->latitude, view_.home()->longitude}, there);
  if (away_m > settings_.max_distance_m)
    return "the place is " + std::to_string(static_cast<int>(away_m)) + " m from home; allowed are " +
           std::to_string(static_cast<int>(settings_.max_distance_m)) + " m (flight.max_distance_m)";
  return {};
}

core::change_or_reason core::wish_to_go(const mission::position& to, instant now) const {
  const auto from = view_.place(now.now_ns);
  if (!from)
    return tl::make_unexpected(std::string("the vehicle tells no position"));
  route::route_request request;
  request.from = {from->latitude, from->longitude};
  request.to = {to.latitude, to.longitude};
  request.altitudes = {std::min(from->altitude_m, to.altitude_m), std::max(from->altitude_m, to.altitude_m)};
  request.margin_m = settings_.fence_margin_m;
  const bool is_fixed_wing = view_.owner().vehicle == flight::vehicle_class::fixed_wing; // turns on a circle
  request.turn_room_m = is_fixed_wing ? settings_.own_loiter_radius_m : turn_room_m;
  const auto way = route::find_route(request, s_.mission->geofences);
  if (!way)
    return tl::make_unexpected("there is no way there: " + way.error().reason);
  wished_change result{change_kind::go_to, last_done(s_), {}, {}};
  const auto name = "goto" + std::to_string(s_.last_task + 1);
  for (std::size_t i = 1; i + 1 < way->points.size(); ++i) {
    mission::waypoint turn;
    turn.id = name + "-" + std::to_string(i);
    turn.at = {way->points[i].latitude_deg, way->points[i].longitude_deg, to.altitude_m};
    turn.accept_radius_m = is_fixed_wing ? 0 : turn_accept_radius_m;
    result.items.emplace_back(std::move(turn));
  }
  result.items.emplace_back(mission::loiter{name, to, 0, stay_s});
  if (s_.set_aside.empty()) {
    const auto first = first_remaining(*s_.mission, last_done(s_));
    result.set_aside.assign(s_.mission->items.begin() + static_cast<std::ptrdiff_t>(first), s_.mission->items.end());
  }
  return result;
}

core::change_or_reason core::wish_to_cancel() const {
  if (s_.set_aside.empty())
    return tl::make_unexpected(std::string("there is nothing to cancel: the vehicle was not sent elsewhere"));
  return wished_change{change_kind::cancel, last_done(s_), s_.set_aside, {}};
}

core::change_or_reason core::wish_to_insert(const operator_words::word& m) const {
  auto after = last_done(s_);
  if (!m.after.empty()) {
    const auto& items = s_.mission->items;
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const auto& each) { return mission::id_of(each) == m.after; });
    if (found == items.end())
      return tl::make_unexpected("the mission has no item '" + m.after + "'");
    if (static_cast<std::size_t>(found - items.begin()) + 1 < first_remaining(*s_.mission, after))
      return tl::make_unexpected("what comes behind item '" + m.after + "' is flown already");
    after = m.after;
  }
  mission::waypoint extra;
  extra.id = "extra" + std::to_string(s_.last_task + 1);
  extra.at = *m.place;
  return wished_change{change_kind::insert, std::move(after), {std::move(extra)}, {}};
}

// As the service will make it, so that nothing is asked of it that can not be flown.
tl::expected<mission::document, std::string> core::changed(const wished_change& wish) const {
  mission::assignment local;
  local.base_revision = s_.mission->revision;
  local.revision = s_.mission->revision + 1;
  local.replace_after_item_id = wish.after_item_id;
  local.items = wish.items;
  if (wish.kind == change_kind::insert) {
    const auto next = first_remaining(*s_.mission, wish.after_item_id);
    local.items.insert(local.items.end(), s_.mission->items.begin() + static_cast<std::ptrdiff_t>(next),
                       s_.mission->items.end());
  }
  return reassign(*s_.mission, local, last_done(s_)).map([](reassigned&& all) { return std::move(all.mission); });
}

// Empty: it can be flown.
std::string core::why_not_changed(const wished_change& wish, instant now) const {
  const auto after = changed(wish);
  if (!after)
    return after.error();
  const auto plan = plan_in_flight(*after, now);
  return plan ? std::string() : plan.error();
}

std::size_t core::first_item(const mission::document& mission) const {
  return s_.flown ? first_to_fly(mission, s_.flown->mission, last_done(s_)) : 0;
}

// A survey that was begun goes on with the line that was begun.
plan::plan_from core::going_on(const mission::document& mission, std::size_t first_item) const {
  return {first_item, lines_flown(s_, mission, first_item)};
}

tl::expected<plan::flight_plan, std::string> core::plan_in_flight(const mission::document& mission, instant now) const {
  const auto where = setting(now);
  if (!where)
    return tl::make_unexpected(std::string("the vehicle tells no position"));
  auto plans = plan::build_plans(mission, *where, going_on(mission, first_item(mission)));
  if (!plans)
    return tl::make_unexpected(plans.error().message());
  if (const auto found = plan::fence_violations(plans->front(), mission, where->vehicle); !found.empty())
    return tl::make_unexpected(found.front().message);
  return std::move(plans->front());
}

// -- what is begun ----------------------------------------------------------------------------------

// Who is sent elsewhere holds first: the mission that goes on meanwhile would fly away from there.
bool core::begin_change(effects& out, instant now) {
  if (!is_in_flight() || (is_plan_finished() && !hovers())) {
    drop_change(out, "the flight was over before");
    return true;
  }
  if (wanted_change_->kind == change_kind::go_to && !view_.obeys(mode_kind::hold)) {
    if (!std::exchange(is_held_for_change_, true)) {
      begin(out, task_kind::hold, {change_mode{mode_kind::hold}});
      return true;
    }
    drop_change(out, "the vehicle does not hold");
    return true;
  }
  is_held_for_change_ = false;
  const auto wish = *std::exchange(wanted_change_, {});
  auto revised = changed(wish); // it may have come further meanwhile
  if (!revised) {
    drop_change(out, revised.error());
    return true;
  }
  change_asked asked;
  asked.what = {
      ids::derived_uuid(s_.mission->mission_id, ids::text_of({changes, static_cast<std::uint64_t>(now.wall_ns)})),
      wish.kind, s_.mission->revision};
  asked.after_item_id = wish.after_item_id;
  asked.items = wish.items;
  asked.reason = reason_for(wish.kind);
  asked.set_aside = wish.set_aside;
  out.emplace_back(note{std::move(asked)});
  if (!settings_.has_service)
    out.emplace_back(note{mission_arrived{*std::move(revised)}});
  return true;
}

void core::drop_change(effects& out, const std::string& why) {
  wanted_change_.reset();
  is_held_for_change_ = false;
  out.emplace_back(announce{"the mission is not changed: " + why, true});
}

effects core::on_change(const mission_client::change_outcome& m, instant) {
  using mission_client::change_verdict;
  if (!s_.change || s_.change->key != m.key)
    return {};
  const bool is_insert = s_.change->kind == change_kind::insert;
  if (m.verdict == change_verdict::done) { // the new revision came before this, and is flown
    refused_inserts_ = 0;
    return {};
  }
  effects out{announce{"the service does not change the mission: " + m.reason, true}};
  // It may have all the same: then the new revision comes as soon as the service answers, and who holds goes on with
  // it.
  if (m.verdict == change_verdict::unknown && s_.change->kind == change_kind::go_to)
    return out;
  out.emplace_back(note{change_settled{m.key, false}});
  if (is_insert && ++refused_inserts_ >= max_refused_inserts && settings_.refused_inserts == refusal_policy::come_home)
    wanted_ = task_kind::come_home;
  return out;
}

// A new revision of the mission that is flown.
bool core::deploy_arrived(effects& out, instant now) {
  if (has_open_intent() || !s_.arrived || !s_.mission || !may_change_plan() ||
      !view_.is_under_way() || s_.arrived->mission_id != s_.mission->mission_id)
    return false;
  if (!setting(now))
    return true; // until the vehicle has said where it is, and where its home is
  const auto plan = plan_in_flight(*s_.arrived, now);
  if (!plan) {
    out.emplace_back(announce{"revision " + std::to_string(s_.arrived->revision) +
                                  " of the mission can not be flown, and the one before stays: " + plan.error(),
                              true});
    out.emplace_back(note{arrival_refused{s_.arrived->revision}});
    return true;
  }
  const bool was_asked_for = s_.change && s_.change->kind != change_kind::insert;
  begin_deploy(out, *s_.arrived, *plan, {}, s_.standing.now != phase::paused || was_asked_for);
  return true;
}

} // namespace godwit::executor
