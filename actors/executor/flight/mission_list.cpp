#include "actors/executor/flight/mission_list.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/remaining.hpp"

namespace godwit::executor {
namespace {

using progress::mission_record;

mission_origin origin_of(const flight_context& flight, const std::string& mission_id) {
  if (flight.s.station && flight.s.station->mission_id == mission_id)
    return mission_origin::station;
  const auto& configured = flight.configured;
  if (configured.has_service && is_of_people(flight.s, mission_id))
    return mission_origin::upload;
  const bool is_configured = !configured.mission_id.empty() && configured.mission_id == mission_id;
  if (configured.has_service)
    return is_configured || configured.asks_next() ? mission_origin::service : mission_origin::unknown;
  return is_configured ? mission_origin::file : mission_origin::upload;
}

// Of an earlier one nobody keeps whether a station or an operator has brought it.
mission_origin earlier_origin_of(const flight_context& flight, const std::string& mission_id) {
  const auto result = origin_of(flight, mission_id);
  return result == mission_origin::upload ? mission_origin::unknown : result;
}

std::string outcome_of(const mission_record& record) {
  const bool is_complete = record.completed_revision && *record.completed_revision >= record.revision;
  if (is_complete)
    return "complete";
  return progress::was_called_off(record) ? "aborted" : "";
}

// What comes of a mission that waits, in the order in which it is looked at.
std::string why_waiting(const flight_context& flight, const std::string& mission_id) {
  if (flight.has_person())
    return "the vehicle is under manual control: it has to be handed back first";
  const bool is_other = !flight.s.mission || flight.s.mission->mission_id != mission_id;
  if (flight.is_in_flight() && is_other)
    return "another mission is flown";
  if (flight.is_in_flight() && flight.may_change_plan())
    return "it is uploaded when the task under way is done";
  if (flight.is_in_flight())
    return "the plan is not changed now: " + flight.sentence();
  if (!flight.view.is_connected() || !flight.view.mode())
    return "the vehicle is not heard";
  if (flight.s.status.now == phase::paused)
    return "the flight is paused: " + flight.sentence();
  return "it is taken when what is under way is done";
}

known_mission current_mission(const flight_context& flight, bool is_deleted) {
  const auto& s = flight.s;
  const auto& record = s.progress.mission;
  known_mission result{.mission_id = s.mission->mission_id,
                       .revision = s.mission->revision,
                       .outcome = {},
                       .last_report_at = {},
                       .items = static_cast<std::uint32_t>(s.mission->items.size()),
                       .items_done = {},
                       .reason = {}};
  result.origin = origin_of(flight, result.mission_id);
  result.items_done = static_cast<std::uint32_t>(first_remaining(*s.mission, last_done(s)));
  if (record && record->mission_id == result.mission_id && record->last_report)
    result.last_report_at = record->last_report->at;
  if (is_over(s.status.now)) {
    result.place = mission_place::ended;
    result.outcome = record ? outcome_of(*record) : "";
    return result;
  }
  result.place = s.status.in_flight ? mission_place::in_flight : mission_place::prepared;
  const bool goes_well = s.status.now == phase::ready || s.status.now == phase::flying;
  if (is_deleted)
    result.reason = "the service has deleted it";
  else if (!goes_well)
    result.reason = flight.sentence();
  return result;
}

known_mission earlier_mission(const flight_context& flight, const mission_record& record) {
  known_mission result{.mission_id = record.mission_id,
                       .revision = record.revision,
                       .outcome = outcome_of(record),
                       .last_report_at = {},
                       .items = {},
                       .items_done = {},
                       .reason = {}};
  result.origin = earlier_origin_of(flight, record.mission_id);
  result.place = result.outcome.empty() ? mission_place::left : mission_place::ended;
  if (record.last_report)
    result.last_report_at = record.last_report->at;
  return result;
}

void add_waiting(const flight_context& flight, std::vector<known_mission>& list) {
  const auto& s = flight.s;
  const auto add = [&](const std::string& id, std::int32_t revision) -> known_mission& {
    auto& added = list.emplace_back();
    added.mission_id = id;
    added.revision = revision;
    added.origin = origin_of(flight, id);
    added.place = mission_place::waiting;
    added.reason = why_waiting(flight, id);
    return added;
  };
  if (s.arrived)
    add(s.arrived->mission_id, s.arrived->revision).items = static_cast<std::uint32_t>(s.arrived->items.size());
  if (s.mission)
    for (const auto& each : s.waiting) // assignments: of this mission, with other items from some place on
      add(s.mission->mission_id, each.revision);
}

void add_refused(const flight_context& flight, const mission_news& news, std::vector<known_mission>& list) {
  const auto add = [&](const std::string& id, mission_origin from, const std::string& why) {
    auto& added = list.emplace_back();
    added.mission_id = id;
    added.origin = from;
    added.place = mission_place::refused;
    added.reason = why;
  };
  const auto& last = flight.refused;
  const auto& now = flight.s.mission;
  const bool is_overtaken = last && now && now->mission_id == last->mission_id && now->revision >= last->revision;
  if (last && !is_overtaken)
    list.push_back(*last);
  if (!news.service_refusal.empty())
    add(flight.configured.mission_id, mission_origin::service, news.service_refusal);
  if (!news.upload_refusal.empty())
    add({}, mission_origin::station, news.upload_refusal);
}

} // namespace

known_missions list_missions(const flight_context& flight, const mission_news& news) {
  const auto& s = flight.s;
  known_missions result;
  if (s.mission)
    result.list.push_back(current_mission(flight, news.is_deleted));
  add_waiting(flight, result.list);
  add_refused(flight, news, result.list);
  const auto& past = s.progress.past_missions;
  const auto count = std::min(past.size(), max_earlier_missions);
  for (auto each = past.rbegin(); each != past.rbegin() + static_cast<std::ptrdiff_t>(count); ++each)
    result.list.push_back(earlier_mission(flight, *each));
  return result;
}

known_mission refused_mission(const flight_context& flight, const std::string& mission_id, std::int32_t revision,
                              std::string why) {
  known_mission result;
  result.mission_id = mission_id;
  result.revision = revision;
  result.origin = origin_of(flight, mission_id);
  result.place = mission_place::refused;
  result.reason = std::move(why);
  return result;
}

} // namespace godwit::executor
