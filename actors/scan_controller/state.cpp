#include "actors/scan_controller/state.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/uuid/uuid.hpp"
#include "io/time_units.hpp"
#include "runtime/assert.hpp"

namespace godwit::scan_controller {
namespace {

using effects = std::vector<durable_core::effect>;
using mapobjects_store::verdict;

auto with_number(std::uint64_t number) {
  return [number](const auto& each) {
    if constexpr (requires { each.what; })
      return each.what.number == number;
    else
      return each.number == number;
  };
}

template <class List>
auto take_out(List& list, std::uint64_t number) {
  const auto found = std::ranges::find_if(list, with_number(number));
  GODWIT_ASSERT(found != list.end(), "scan_controller: a fact is about a point that is there");
  auto result = std::move(*found);
  list.erase(found);
  return result;
}

std::uint64_t& count_of(point_counts& counts, drop_reason why) {
  switch (why) {
  case drop_reason::too_faint:
    return counts.too_faint;
  case drop_reason::no_room:
    return counts.no_room;
  case drop_reason::too_old:
    break;
  }
  return counts.too_old;
}

std::uint64_t& count_of(point_counts& counts, point_outcome outcome) {
  switch (outcome) {
  case point_outcome::confirmed:
    return counts.confirmed;
  case point_outcome::declined:
    return counts.declined;
  case point_outcome::passed_over:
    break;
  }
  return counts.passed_over;
}

void remember(state& s, closed_point what) {
  s.closed.push_back(std::move(what));
  if (s.closed.size() <= max_closed)
    return;
  const auto forgotten =
      std::ranges::find_if(s.closed, [](const closed_point& each) { return each.outcome != point_outcome::confirmed; });
  s.closed.erase(forgotten == s.closed.end() ? s.closed.begin() : forgotten);
}

point_closed end_showing(state& s, open_point open, point_outcome outcome, const std::string& by, std::int64_t at_ns) {
  ++count_of(s.counts, outcome);
  point_closed told{open.what.number, s.mission_id, outcome, by};
  remember(s, {std::move(open.what), outcome, by, at_ns});
  return told;
}

effects put(state& s, const clock_restarted& m) {
  const auto back = [&](std::int64_t& ns) { ns -= m.behind_ns; };
  back(s.newest_ns);
  std::ranges::for_each(s.shown_ns, back);
  for (auto& each : s.waiting)
    back(each.seen_ns);
  for (auto& each : s.shown) {
    back(each.what.seen_ns);
    back(each.until_ns);
  }
  for (auto& each : s.closed) {
    back(each.what.seen_ns);
    back(each.closed_ns);
  }
  for (auto& each : s.owed_passes)
    back(each.due_ns);
  return {};
}

effects put(state& s, const mission_begun& m) {
  effects result;
  for (auto& each : s.shown)
    result.emplace_back(end_showing(s, std::move(each), point_outcome::passed_over, {}, m.at_ns));
  s.counts.mission_over += s.waiting.size();
  s.shown.clear();
  s.waiting.clear();
  s.closed.clear();
  if (s.pass && s.pass->mission_id != m.mission_id)
    s.pass.reset();
  s.mission_id = m.mission_id;
  return result;
}

effects put(state& s, const point_opened& m) {
  if (m.again != 0)
    (void)take_out(s.closed, m.again);
  ++s.counts.opened;
  s.last_number = m.what.number;
  s.waiting.push_back(m.what);
  return {};
}

effects put(state& s, const point_seen& m) {
  const auto is_it = with_number(m.now.number);
  if (const auto open = std::ranges::find_if(s.shown, is_it); open != s.shown.end())
    open->what = m.now;
  else
    std::ranges::replace_if(s.waiting, is_it, m.now);
  return {};
}

effects put(state& s, const point_dropped& m) {
  if (m.number == 0)
    ++s.counts.opened;
  else
    (void)take_out(s.waiting, m.number);
  ++count_of(s.counts, m.why);
  return {};
}

effects put(state& s, const showing_begun& m) {
  auto what = take_out(s.waiting, m.number);
  s.shown_ns.push_back(m.at_ns);
  if (s.shown_ns.size() > max_shown_times)
    s.shown_ns.erase(s.shown_ns.begin());
  point_shown told;
  told.number = what.number;
  told.mission_id = s.mission_id;
  told.class_group = what.class_group;
  told.position = what.position;
  told.confidence = what.confidence;
  told.has_moved = what.has_moved;
  told.shown_ns = m.at_ns;
  told.window_ms = m.window_ms;
  told.most_a_minute = m.most_a_minute;
  s.shown.push_back({std::move(what), m.at_ns + m.window_ms * ns_per_ms});
  return {std::move(told)};
}

effects put(state& s, const showing_ended& m) {
  auto open = take_out(s.shown, m.number);
  if (m.outcome != point_outcome::passed_over) {
    const auto& what = open.what;
    s.owed.push_back({ids::derived_uuid(s.mission_id, what.id), s.mission_id, what.class_group, what.position,
                      m.outcome == point_outcome::confirmed ? verdict::confirmed : verdict::declined, m.wall_ns});
  }
  return {end_showing(s, std::move(open), m.outcome, m.by, m.at_ns)};
}

effects put(state& s, const verdict_delivered& m) {
  std::erase_if(s.owed, [&](const auto& each) { return each.id == m.id; });
  return {};
}

effects put(state& s, const pass_begun& m) {
  s.pass = m.what;
  return {};
}

effects put(state& s, const pass_advanced& m) {
  s.pass->lines_done = m.lines_done;
  return {};
}

effects put(state& s, const pass_lost&) {
  s.pass->is_over = true;
  return {};
}

effects put(state& s, const pass_completed& m) {
  s.pass->is_over = true;
  s.owed_passes.push_back(m.owed);
  return {};
}

effects put(state& s, const pass_delivered& m) {
  std::erase_if(s.owed_passes, [&](const auto& each) { return each.what.id == m.id; });
  return {};
}

} // namespace

std::vector<durable_core::effect> durable_core::apply(state& s, const event& happened, std::int64_t) {
  return std::visit(
      [&](const auto& what) {
        if constexpr (requires { what.at_ns; })
          s.newest_ns = std::max(s.newest_ns, what.at_ns);
        return put(s, what);
      },
      happened);
}

} // namespace godwit::scan_controller
