#include "actors/executor/flight/stations/gcs_view.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "actors/domain/mission/rules.hpp"
#include "actors/domain/mission/version.hpp"
#include "actors/executor/flight/new_run.hpp"
#include "actors/executor/station_part.hpp"
#include "actors/executor/station_plan.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_mission_type;

constexpr std::int64_t tell_period_ns = 1'000'000'000;

bool is_same(const ground_port::mission_progress& a, const ground_port::mission_progress& b) {
  return a.plan_id == b.plan_id && a.current == b.current && a.state == b.state && a.mode == b.mode &&
         a.is_sent_elsewhere == b.is_sent_elsewhere;
}

// After a flight that ended under its person: the start has given the vehicle back, and says that it goes on.
bool prepare_again(flight_context& flight) {
  if (!flight.wanted.hand_back || flight.is_in_flight() || flight.s.status.now != phase::paused)
    return false;
  flight.wanted.put_go_on();
  return true;
}

} // namespace

// -- what they upload -------------------------------------------------------------------------------

effects gcs_view::on_plan(const plan_taken& m, bool has_looked, instant now) {
  effects out;
  auto how = take(out, m, has_looked, now);
  if (how == verdict::refused && counts(m))
    how = verdict::taken;
  out.emplace_back(send_to_port{ground_port::plan_judged{m.type, m.plan_id, how}});
  return out;
}

gcs_view::verdict gcs_view::take(effects& out, const plan_taken& m, bool has_looked, instant now) {
  if (m.type == mav_mission_type::mission)
    return take_plan(out, m, has_looked, now);
  out = m.type == mav_mission_type::fence ? take_fence(m.items) : take_rally(m.items);
  const bool is_noted = std::ranges::any_of(out, [](const effect& each) { return std::holds_alternative<note>(each); });
  return is_noted ? verdict::taken : verdict::refused;
}

// That it counted before makes no difference to who has uploaded it.
bool gcs_view::counts(const plan_taken& m) const {
  if (m.type == mav_mission_type::mission)
    return flies_upload(flight_.s) && flight_.s.station->plan_id == m.plan_id; // and nobody has changed it since
  if (m.type == mav_mission_type::rally)
    return io::mavlink::checksum_of(m.items) == io::mavlink::checksum_of(flight_.s.station_rally);
  const auto fence = mission::import_fence_list(m.items);
  return fence && fence->geofences == flight_.s.station_fences &&
         fence->breach_return_point == flight_.s.station_breach_return_point;
}

effects gcs_view::on_cleared(const plan_cleared& m, bool has_looked, instant now) {
  effects out;
  if (m.type == mav_mission_type::mission) {
    told_plan_id_ = 0; // the port shows nothing now
    clearing_.begin(out, has_looked, now);
    return out;
  }
  out = m.type == mav_mission_type::fence ? take_fence({}) : take_rally({});
  out.emplace_back(send_to_port{ground_port::plan_judged{m.type, 0, ground_port::plan_verdict::taken}});
  return out;
}

// What stands here instead is shown to the station again.
effects gcs_view::not_taken(const std::string& why) {
  refused_upload_ = "the plan is not taken: " + why;
  told_plan_id_ = 0;
  return {announce{refused_upload_, true}};
}

// Stations write ArduPilot's home, which it keeps itself, as the first item.
bool gcs_view::begins_with_home(const std::vector<io::mavlink::mission_item_int>& items) const {
  using io::mavlink::mav_frame;
  if (!flight_.plan_has_home() || items.empty())
    return false;
  const auto frame = static_cast<mav_frame>(items.front().frame);
  return items.front().command == io::mavlink::number(io::mavlink::mav_cmd::nav_waypoint) &&
         (frame == mav_frame::global || frame == mav_frame::global_int);
}

std::string gcs_view::why_no_plan(const plan_taken& m, bool has_looked) const {
  if (auto elsewhere = flight_.missions_come_from_elsewhere(); !elsewhere.empty())
    return elsewhere;
  if (is_flight_begun(flight_.s))
    return uploads_.why_not(m.by, has_looked);
  if (flight_.has_person() && flight_.s.person != m.by) // its own is kept, and brought after the hand-back
    return "the vehicle has to be handed back first";
  return {};
}

// In flight it is the next revision of what is flown, with the fences of the flight.
tl::expected<mission::imported_list, mission::conversion_error> gcs_view::import_plan(const plan_taken& m,
                                                                                      instant now) const {
  const auto* const flown = is_flight_begun(flight_.s) ? &*flight_.s.mission : nullptr;
  mission::item_list_options options;
  options.mission_id = flown != nullptr ? flown->mission_id : new_mission_id(m.plan_id, now.wall_ns);
  options.allow_partial = flight_.configured.allow_partial;
  options.vehicle = flight_.view.profile();
  options.allowed = flight_.configured.allowed_commands;
  options.fence = {flight_.s.station_fences, flight_.s.station_breach_return_point};
  if (flown != nullptr)
    options.fence = {flown->geofences, flown->breach_return_point};
  auto taken = mission::import_item_list(std::span(m.items).subspan(begins_with_home(m.items) ? 1 : 0), options);
  if (taken && flown != nullptr)
    taken->mission.revision = flown->revision + 1;
  return taken;
}

gcs_view::verdict gcs_view::take_plan(effects& out, const plan_taken& m, bool has_looked, instant now) {
  const auto refuse = [&](const std::string& why) {
    out = not_taken(why);
    return verdict::refused;
  };
  if (const auto why = why_no_plan(m, has_looked); !why.empty())
    return refuse(why);
  const bool is_flown = is_flight_begun(flight_.s);
  if (is_flown && counts(m) && !flight_.is_plan_finished())
    return verdict::taken; // it goes on where it was
  auto taken = import_plan(m, now);
  if (!taken)
    return refuse(taken.error().message());
  if (const auto why = flight_.why_out_of_limits(taken->mission, 0, now); !why.empty())
    return refuse(why);
  station_plan plan;
  plan.mission_id = taken->mission.mission_id;
  plan.revision = taken->mission.revision;
  plan.plan_id = m.plan_id;
  plan.items = static_cast<std::uint16_t>(m.items.size());
  plan.places = std::move(taken->places);
  plan.by = m.by;
  station_plan_taken next{std::move(plan), std::move(taken->mission)};
  if (is_flown)
    if (const auto why = uploads_.begin(out, next, now); !why.empty())
      return refuse(why);
  refused_upload_.clear();
  if (!taken->losses.empty())
    out.emplace_back(announce{"the plan is taken without this: " + taken->losses.message(), true});
  if (is_flown)
    return verdict::bringing;
  const bool is_brought = on_ground_.begin(out, m.plan_id, now);
  out.emplace_back(note{std::move(next)});
  if (flight_.s.status.now == phase::paused && !flight_.has_person())
    phases_.go(out, trigger::mission_changed);
  return is_brought ? verdict::bringing : verdict::taken;
}

effects gcs_view::take_fence(const std::vector<io::mavlink::mission_item_int>& items) {
  if (auto elsewhere = flight_.who_else_brings_missions(); !elsewhere.empty())
    return items.empty() ? effects{} : not_taken("fences come from " + elsewhere + " here");
  auto fence = mission::import_fence_list(items);
  if (!fence)
    return {announce{"the fence is not taken: " + fence.error(), true}};
  if (const auto* uploaded = uploaded_mission(flight_.s)) {
    auto fenced = *uploaded;
    mission::put_fences(fenced, fence->geofences, fence->breach_return_point);
    if (const auto problems = mission::broken_rules(fenced); !problems.empty())
      return {announce{"the fence is not taken: " + problems.front().message(), true}};
  }
  effects out{note{station_fence_taken{std::move(fence->geofences), fence->breach_return_point}}};
  if (is_flight_begun(flight_.s))
    out.emplace_back(announce{"the fence counts from the next flight on", true});
  return out;
}

// godwit flies to none of them: they go to the vehicle with the station's plan.
effects gcs_view::take_rally(const std::vector<io::mavlink::mission_item_int>& items) {
  if (auto elsewhere = flight_.missions_come_from_elsewhere(); !elsewhere.empty())
    return items.empty() ? effects{} : effects{announce{"the rally points are not used: " + elsewhere, true}};
  if (!flight_.configured.brings_last_line)
    return items.empty() ? effects{} : effects{announce{"the rally points are not used (flight.last_line)", true}};
  return {note{station_rally_taken{items}}};
}

// -- what they start --------------------------------------------------------------------------------

effects gcs_view::on_start(const start_mission& m, instant now) {
  effects out;
  const bool has_taken_off = flight_.has_person() && flight_.is_in_air();
  if (now.wall_ns > m.obey_until_ns)
    tasks_.answer_start(out, m.key, start_verdict::too_late, "the request came too late");
  else if (const auto why = why_not_meant(m); !why.empty())
    tasks_.answer_start(out, m.key, start_verdict::no_such_item, why);
  else if (flight_.has_person() && !watch_.may_hand_back(m.asked_by))
    tasks_.answer_start(out, m.key, start_verdict::not_ready, flight_.s.status.reason);
  else if (hand_back(); fly_again(out, m, now) || prepare_again(flight_))
    tasks_.answer_start(out, m.key, start_verdict::not_ready, "it is prepared anew; start it when it is ready");
  else if (flight_.wanted.start || (flight_.runner.is_busy() && !uploads_.is_under_way()))
    tasks_.answer_start(out, m.key, start_verdict::not_ready, "something else is under way: " + flight_.sentence());
  else
    flight_.wanted.start = start_flight{m, has_taken_off};
  return out;
}

// The station's own arm or mode has made it its person's; its start gives it back.
void gcs_view::hand_back() { flight_.wanted.hand_back = flight_.wanted.hand_back || flight_.has_person(); }

std::string gcs_view::why_not_meant(const start_mission& m) {
  const auto& plan = shown();
  if (m.plan_id != plan.plan_id)
    return refused_upload_.empty() ? "another plan is here by now; load it from the vehicle" : refused_upload_;
  if (!plan.is_upload && m.last + std::size_t{1} < plan.items)
    return "only a plan of a station is flown in part, as it came";
  return {};
}

// A station's plan that was flown, or the part of it that is asked for, is flown again as another mission; so is the
// mission of a file or of the page.
bool gcs_view::fly_again(effects& out, const start_mission& m, instant now) {
  if (!is_at_rest(flight_.s.status.now) || flight_.s.arrived)
    return false;
  const auto again = part_of_plan(flight_.s, {m.first, m.last}, !flight_.drives());
  if (again)
    out.emplace_back(note{as_new_mission(*again, now.wall_ns)});
  else
    flight_.wanted.new_run = why_no_new_run(flight_).empty();
  return again || flight_.wanted.new_run;
}

// -- what they see ----------------------------------------------------------------------------------

const gcs_view::shown_plan& gcs_view::shown() {
  if (shown_)
    return *shown_;
  shown_plan next;
  if (shows_upload(flight_.s))
    next = {flight_.s.station->plan_id, flight_.s.station->items, true};
  else if (const auto items = items_on_vehicle(flight_.s, flight_.configured.shows_home); !items.empty())
    next = {io::mavlink::checksum_of(items), items.size(), false};
  return shown_.emplace(next);
}

effects gcs_view::tell(instant now) {
  effects out;
  const auto& plan = shown();
  if (plan.plan_id == 0)
    return out;
  if (plan.plan_id != told_plan_id_) {
    if (!plan.is_upload)
      out.emplace_back(
          send_to_port{ground_port::set_mission{items_on_vehicle(flight_.s, flight_.configured.shows_home)}});
    told_plan_id_ = plan.plan_id;
  }
  const auto progress = progress_shown(flight_.s, flight_.view, plan.plan_id, flight_.configured.shows_home);
  if (is_same(progress, told_progress_) && now.now_ns - told_progress_ns_ < tell_period_ns)
    return out;
  told_progress_ = progress;
  told_progress_ns_ = now.now_ns;
  out.emplace_back(send_to_port{progress});
  return out;
}

} // namespace godwit::executor
