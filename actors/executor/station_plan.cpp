#include "actors/executor/station_plan.hpp"

#include <algorithm>

#include "actors/executor/remaining.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mission_mode;
using io::mavlink::mission_state;

std::optional<std::uint16_t> place_by_id(const station_plan& plan, const std::string& id) {
  const auto found = std::ranges::find(plan.ids, id);
  const auto index = static_cast<std::size_t>(found - plan.ids.begin());
  return index < plan.places.size() && found != plan.ids.end() ? std::optional(plan.places[index]) : std::nullopt;
}

// In the upload, of the item at INDEX of the mission that is flown. None: an operator has sent the vehicle there.
std::optional<std::uint16_t> place_in_upload(const state& s, std::size_t index) {
  const auto& places = s.station->places;
  if (flies_upload(s))
    return index < places.size() ? std::optional(places[index]) : std::nullopt;
  const auto& items = s.flown->mission.items;
  return index < items.size() ? place_by_id(*s.station, mission::id_of(items[index])) : std::nullopt;
}

std::optional<std::uint16_t> place_at(const state& s, std::uint16_t sequence) {
  const auto position = progress::position_at(s.progress.plan->map, sequence);
  return position ? place_in_upload(s, s.progress.plan->map.items[*position].item_index) : std::nullopt;
}

// With which the mission would go on from a place to which an operator has sent the vehicle.
std::uint16_t place_to_go_on(const state& s) {
  for (const auto& each : s.set_aside)
    if (const auto place = place_by_id(*s.station, mission::id_of(each)))
      return *place;
  return static_cast<std::uint16_t>(s.station->items - 1);
}

// After an operator had sent the vehicle elsewhere it has the rest of the upload, without what was flown before.
bool is_left_behind(const state& s, std::uint16_t index) {
  std::optional<std::uint16_t> chosen; // the item at INDEX, or the next one that is flown as one of its own
  for (const auto place : s.station->places)
    if (place >= index && (!chosen || place < *chosen))
      chosen = place;
  return std::ranges::none_of(s.progress.plan->map.items,
                              [&](const auto& each) { return place_in_upload(s, each.item_index) == chosen; });
}

// Of the plan that is shown, for SEQUENCE of the vehicle.
std::optional<std::uint16_t> shown_at(const state& s, std::uint16_t sequence, bool with_home) {
  const auto& map = s.progress.plan->map;
  if (!progress::has_sequence(map, sequence))
    return std::nullopt;
  if (shows_upload(s))
    return place_at(s, sequence);
  return with_home ? sequence : static_cast<std::uint16_t>(sequence - map.first_sequence);
}

std::optional<std::uint16_t> current_shown(const state& s, std::uint16_t sequence, bool with_home) {
  const auto shown = shown_at(s, sequence, with_home);
  return shown || !shows_upload(s) || flies_upload(s) ? shown : place_to_go_on(s);
}

mission_state state_shown(const state& s) {
  const auto& at = s.status;
  if (at.in_flight)
    return at.now == phase::paused ? mission_state::paused : mission_state::active;
  const bool is_flown = at.now == phase::post_flight || at.now == phase::done;
  return is_flown ? mission_state::complete : mission_state::not_started;
}

} // namespace

const mission::document* uploaded_mission(const state& s) {
  const auto& next = s.arrived ? s.arrived : s.mission;
  const bool is_it =
      s.station && next && next->mission_id == s.station->mission_id && next->revision == s.station->revision;
  return is_it ? &*next : nullptr;
}

bool shows_upload(const state& s) {
  if (flies_upload(s))
    return true;
  const auto& next = s.arrived ? s.arrived : s.mission;
  if (!s.status.in_flight || !s.flown || !s.station || s.station->ids.empty() || !next ||
      next->mission_id != s.station->mission_id)
    return false;
  return std::ranges::all_of(next->items, [&](const mission::item& each) {
    const auto& id = mission::id_of(each);
    return is_of_change(id) || place_by_id(*s.station, id);
  });
}

std::vector<io::mavlink::mission_item_int> items_on_vehicle(const state& s, bool with_home) {
  std::vector<io::mavlink::mission_item_int> result;
  if (!s.flown || !s.progress.plan)
    return result;
  const auto before = std::min<std::size_t>(s.progress.plan->map.first_sequence, s.flown->items.size());
  const auto first = with_home ? 0 : static_cast<std::ptrdiff_t>(before);
  result.assign(s.flown->items.begin() + first, s.flown->items.end());
  std::uint16_t sequence = 0;
  for (auto& each : result) {
    each.seq = sequence++;
    each.current = 0;
  }
  return result;
}

std::optional<std::uint16_t> vehicle_sequence_of(const state& s, std::uint16_t index, bool with_home) {
  if (!s.progress.plan)
    return std::nullopt;
  const auto& map = s.progress.plan->map;
  if (!shows_upload(s)) {
    const auto sequence = static_cast<std::uint32_t>(index) + (with_home ? 0U : map.first_sequence);
    const auto after_home = std::max<std::uint32_t>(sequence, map.first_sequence);
    return after_home < end_sequence(map) ? std::optional(static_cast<std::uint16_t>(after_home)) : std::nullopt;
  }
  if (!flies_upload(s) && is_left_behind(s, index))
    return std::nullopt;
  const auto found = std::ranges::find_if(map.items, [&](const auto& each) {
    const auto place = place_in_upload(s, each.item_index);
    return each.sequence_count != 0 && place && *place >= index;
  });
  return found == map.items.end() ? std::nullopt : std::optional(found->first_sequence);
}

ground_port::mission_progress progress_shown(const state& s, const vehicle_view& view, std::uint32_t plan_id,
                                             bool with_home) {
  ground_port::mission_progress result;
  result.plan_id = plan_id;
  result.state = state_shown(s);
  const bool is_called_back = s.change && s.change->kind == change_kind::cancel;
  result.is_sent_elsewhere = s.status.in_flight && !s.set_aside.empty() && !is_called_back;
  if (view.mode())
    result.mode = view.is_in(flight::mode_kind::mission) ? mission_mode::active : mission_mode::suspended;
  const bool is_followed = s.progress.plan && s.mission && s.flown &&
                           s.flown->mission.mission_id == s.mission->mission_id && (!s.arrived || s.status.in_flight);
  if (is_followed) {
    const auto& generation = s.progress.plan->generation;
    const auto at = generation.is_armed ? generation.moved_to.value_or(generation.current) : generation.start_sequence;
    result.current = current_shown(s, at, with_home).value_or(0);
  }
  return result;
}

std::optional<ground_port::item_reached> reached_shown(const state& s, const mission::progress_report& report,
                                                       bool with_home) {
  const bool is_of_plan = s.progress.plan && report.generation == s.progress.plan->generation.number;
  const bool is_done = report.kind == mission::progress_kind::reached || report.kind == mission::progress_kind::passed;
  if (!is_done || !is_of_plan || !report.item_index)
    return std::nullopt;
  const auto& items = s.progress.plan->map.items;
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const auto& each) { return each.item_index == *report.item_index; });
  if (found == items.end() || found->sequence_count == 0)
    return std::nullopt;
  const auto sequence = shown_at(s, progress::done_sequence(*found), with_home);
  return sequence ? std::optional(ground_port::item_reached{*sequence, report.mission_id, report.report_no})
                  : std::nullopt;
}

} // namespace godwit::executor
