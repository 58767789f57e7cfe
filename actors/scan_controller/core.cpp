#include "actors/scan_controller/core.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/scan_controller/point.hpp"
#include "io/fields/field_table.hpp"
#include "io/time_units.hpp"

namespace godwit::scan_controller {
namespace {

geo::point place_of(const mapobjects_store::geo_position& at) { return {at.latitude_deg, at.longitude_deg}; }

// On the monotonic clock. What is dated in the future was seen now.
std::int64_t seen_ns(const candidate& seen, instant now) {
  return now.monotonic_ns - std::max<std::int64_t>(now.wall_ns - seen.at_ns, 0);
}

point with(point known, const candidate& seen, std::int64_t at_ns) {
  if (!known.object_id)
    known.object_id = seen.object_id;
  known.confidence = std::max(known.confidence, seen.confidence);
  known.has_moved = known.has_moved || seen.has_moved;
  if (at_ns >= known.seen_ns) {
    known.position = seen.position;
    known.seen_ns = at_ns;
  }
  return known;
}

bool is_worth_writing(const point& before, const point& after) {
  return after.confidence > before.confidence || after.has_moved != before.has_moved ||
         after.object_id != before.object_id || after.seen_ns - before.seen_ns >= core::refresh_ns ||
         geo::distance_m(place_of(before.position), place_of(after.position)) > core::refresh_m;
}

decide_answer refused(std::string why) { return {false, std::move(why)}; }

std::string name_of_point(std::uint64_t number) { return "point " + std::to_string(number); }

point_view view_of_point(const point& what, instant now) {
  point_view result;
  result.number = what.number;
  result.class_group = what.class_group;
  result.position = what.position;
  result.confidence = what.confidence;
  result.has_moved = what.has_moved;
  result.seen_ago_ms = std::max<std::int64_t>(now.monotonic_ns - what.seen_ns, 0) / ns_per_ms;
  return result;
}

// Of one that is not shown.
decide_answer answer_to_late(const state& s, const decide_point& said, point_outcome wanted) {
  const auto closed =
      std::ranges::find_if(s.closed, [&](const closed_point& each) { return each.what.number == said.number; });
  if (closed != s.closed.end()) {
    if (closed->outcome == wanted)
      return {true, {}};
    if (closed->outcome == point_outcome::passed_over)
      return refused(name_of_point(said.number) + " was passed over: the time to decide about it is over");
    return refused(name_of_point(said.number) + " was " + std::string(io::name_of(closed->outcome)) + " by " +
                   closed->by + " before");
  }
  const bool waits = std::ranges::any_of(s.waiting, [&](const point& each) { return each.number == said.number; });
  if (waits)
    return refused(name_of_point(said.number) + " is not shown yet; its turn comes");
  return refused("there is no point " + std::to_string(said.number) +
                 " that is shown; `godwitd ctl points` lists them");
}

} // namespace

std::optional<fact> core::on_start(const state& s, instant now) {
  if (s.newest_ns <= now.monotonic_ns)
    return {};
  return clock_restarted{s.newest_ns - now.monotonic_ns};
}

core::judged core::on_candidate(const state& s, const candidate& seen, instant now) const {
  const bool is_first = seen.mission_id != s.mission_id;
  if (is_first)
    return seen.is_known ? judged{} : open(s, seen, 0, true, now);
  const auto within_m = settings_.merge_within_m;
  const auto* const open_one = find_match(s.shown, seen, within_m);
  if (const auto* known = open_one != nullptr ? &open_one->what : find_match(s.waiting, seen, within_m)) {
    judged result{{}, {candidate_fate::merged, known->number}};
    auto after = with(*known, seen, seen_ns(seen, now));
    if (is_worth_writing(*known, after))
      result.facts.emplace_back(point_seen{std::move(after), now.monotonic_ns});
    return result;
  }
  if (const auto* closed = find_match(s.closed, seen, within_m)) {
    const bool is_long_ago = now.monotonic_ns - closed->closed_ns > keep_ns();
    if (closed->outcome != point_outcome::passed_over || !is_long_ago)
      return {{}, {candidate_fate::resolved, closed->what.number}};
    return open(s, seen, closed->what.number, false, now);
  }
  return seen.is_known ? judged{} : open(s, seen, 0, false, now);
}

// AGAIN: number of one that was passed over long ago. IS_FIRST: of another mission than the points that are there.
core::judged core::open(const state& s, const candidate& seen, std::uint64_t again, bool is_first, instant now) const {
  judged result;
  if (is_first)
    result.facts.emplace_back(mission_begun{seen.mission_id, now.monotonic_ns});
  const auto drop = [&](std::uint64_t number, drop_reason why) {
    result.facts.emplace_back(point_dropped{number, why, now.monotonic_ns});
  };
  point made{s.last_number + 1, seen.id,         seen.object_id, seen.class_group,
             seen.position,     seen.confidence, seen.has_moved, seen_ns(seen, now)};
  if (now.monotonic_ns - made.seen_ns > keep_ns()) {
    drop(0, drop_reason::too_old);
    result.answer.fate = candidate_fate::too_old;
    return result;
  }
  if (!is_first && s.waiting.size() >= max_waiting) {
    const auto worst = std::ranges::max_element(s.waiting, [&](const point& a, const point& b) {
      return goes_before(rank(a, now.monotonic_ns), rank(b, now.monotonic_ns));
    });
    if (!goes_before(rank(made, now.monotonic_ns), rank(*worst, now.monotonic_ns))) {
      drop(0, drop_reason::no_room);
      result.answer.fate = candidate_fate::no_room;
      return result;
    }
    drop(worst->number, drop_reason::no_room);
  }
  result.answer = {candidate_fate::opened, made.number};
  result.facts.emplace_back(point_opened{std::move(made), again, now.monotonic_ns});
  return result;
}

core::decided core::on_decision(const state& s, const decide_point& said, instant now) {
  const auto wanted = said.says == decision::confirm ? point_outcome::confirmed : point_outcome::declined;
  const auto open =
      std::ranges::find_if(s.shown, [&](const open_point& each) { return each.what.number == said.number; });
  if (open == s.shown.end())
    return {{}, answer_to_late(s, said, wanted)};
  if (now.monotonic_ns >= open->until_ns)
    return {{}, refused(name_of_point(said.number) + " was passed over: the time to decide about it is over")};
  if (s.owed.size() >= max_owed)
    return {
        {},
        refused("the map has not taken the decisions before; send it again when `godwitd ctl status` shows it well")};
  return {showing_ended{said.number, wanted, said.by, now.monotonic_ns, now.wall_ns}, {true, {}}};
}

std::optional<fact> core::next_due(const state& s, instant now) const {
  const auto at_ns = now.monotonic_ns;
  const auto over = std::ranges::find_if(s.shown, [&](const open_point& each) { return each.until_ns <= at_ns; });
  if (over != s.shown.end())
    return showing_ended{over->what.number, point_outcome::passed_over, {}, at_ns, now.wall_ns};
  const auto old = std::ranges::find_if(s.waiting, [&](const point& each) { return at_ns - each.seen_ns > keep_ns(); });
  if (old != s.waiting.end())
    return point_dropped{old->number, is_above(*old) ? drop_reason::too_old : drop_reason::too_faint, at_ns};
  if (at_ns < next_turn_ns(s))
    return {};
  if (const auto* best = best_waiting(s, at_ns))
    return showing_begun{best->number, settings_.window_ms, settings_.shown_a_minute, at_ns};
  return {};
}

std::int64_t core::next_deadline_ns(const state& s) const {
  auto result = never_ns;
  for (const auto& each : s.shown)
    result = std::min(result, each.until_ns);
  for (const auto& each : s.waiting)
    result = std::min(result, each.seen_ns + keep_ns() + 1);
  if (std::ranges::any_of(s.waiting, [&](const point& each) { return is_above(each); }))
    result = std::min(result, next_turn_ns(s));
  return result;
}

// More than the window after the point before which so many were shown: also both ends of 60 s count.
std::int64_t core::next_turn_ns(const state& s) const {
  const std::size_t most = settings_.shown_a_minute;
  if (s.shown_ns.size() < most)
    return std::numeric_limits<std::int64_t>::min();
  return s.shown_ns[s.shown_ns.size() - most] + rate_window_ns + 1;
}

const point* core::best_waiting(const state& s, std::int64_t now_ns) const {
  const point* best = nullptr;
  ranked rank_of_best;
  for (const auto& each : s.waiting) {
    if (!is_above(each))
      continue;
    const auto its = rank(each, now_ns);
    if (best != nullptr && !goes_before(its, rank_of_best))
      continue;
    best = &each;
    rank_of_best = its;
  }
  return best;
}

ranked core::rank(const point& what, std::int64_t now_ns) const {
  return {is_above(what), priority_of(what, vehicle_, now_ns), what.number};
}

points core::view_of(const state& s, instant now) {
  points result;
  result.mission_id = s.mission_id;
  for (const auto& each : s.shown) {
    auto& view = result.shown.emplace_back(view_of_point(each.what, now));
    view.decide_within_ms = std::max<std::int64_t>(each.until_ns - now.monotonic_ns, 0) / ns_per_ms;
  }
  for (const auto& each : s.closed)
    if (each.outcome == point_outcome::confirmed)
      result.confirmed.emplace_back(view_of_point(each.what, now)).by = each.by;
  result.waiting = static_cast<std::uint32_t>(s.waiting.size());
  result.counts = s.counts;
  return result;
}

} // namespace godwit::scan_controller
