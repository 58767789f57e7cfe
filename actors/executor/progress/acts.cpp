#include "actors/executor/progress/acts.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "actors/executor/progress/advance.hpp"
#include "actors/executor/progress/patience.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor::progress {

namespace {

using io::mavlink::mav_cmd;
using mission::act_outcome;

// A number that is further on is no gap: the camera began to count anew.
constexpr std::int64_t max_unheard_pictures = 1'000;

bool is_known(const followed_plan& plan, std::uint32_t position) {
  return std::ranges::find(plan.generation.acts, position, &resolved_act::position) != plan.generation.acts.end();
}

// The item that the vehicle flies to.
std::optional<std::uint32_t> under_way(const followed_plan& plan) {
  const auto& g = plan.generation;
  const auto position = position_at(plan.map, g.current);
  return position && *position >= g.resolved && plan.map.items[*position].last_nav_sequence ? position : std::nullopt;
}

// The first act of the kind WANTED that the vehicle has come to, and of which nothing is known.
std::optional<std::uint32_t> due_act(const followed_plan& plan, act_kind wanted) {
  const auto& g = plan.generation;
  const auto at = g.moved_to.value_or(g.current);
  for (auto i = g.resolved; i < plan.map.items.size(); ++i) {
    const auto& item = plan.map.items[i];
    if (item.last_nav_sequence && !(g.moved_to && is_passed(item, at)))
      break;
    if (item.act == wanted && !is_known(plan, i))
      return i;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> act_reported(const followed_plan& plan, act_kind what) {
  const auto here = under_way(plan);
  const bool may_be_placement = what == act_kind::placement || what == act_kind::release;
  if (here && may_be_placement && plan.map.items[*here].act == act_kind::placement && !is_known(plan, *here))
    return here;
  return due_act(plan, what);
}

bool counts(const decision_context& t) { return t.s.plan && !t.s.paused && t.s.plan->generation.is_armed; }

void resolve_act(decision_context& t, const resolved_act& what, const std::string& reported) {
  auto& plan = *t.s.plan;
  plan.generation.acts.push_back(what);
  if (what.outcome == act_outcome::failed)
    tell(t, progress_event_kind::act_failed,
         "item '" + plan.map.items[what.position].item_id + "' has failed: " + reported);
}

void count_pictures(mission::picture_count& to, std::int32_t index, std::uint32_t count) {
  if (count == 0)
    return;
  to.taken += count;
  if (!to.first)
    to.first = static_cast<std::int32_t>(index - static_cast<std::int64_t>(count) + 1);
  to.last = index;
}

void count_early_picture(generation_state& g, mission::picture_count& to) {
  if (const auto early = std::exchange(g.early, std::nullopt))
    count_pictures(to, early->index, early->count);
}

// After the item at POSITION a picture is taken, or a line begins.
bool precedes_picture(const plan_map& map, std::uint32_t position) {
  for (auto i = position + 1; i < map.items.size(); ++i) {
    const auto& next = map.items[i];
    if (next.act == act_kind::picture || next.last_nav_sequence)
      return next.act == act_kind::picture || next.pictures > 0;
  }
  return false;
}

// The vehicle has moved on to a line.
bool is_on_next_line(const followed_plan& plan) {
  const auto& to = plan.generation.moved_to;
  const auto position = to ? position_at(plan.map, *to) : std::nullopt;
  return position && plan.map.items[*position].pictures > 0;
}

// A picture belongs to the way that follows the one which is not resolved. The last ones of a line are reported up to a
// second after it was left.
bool is_of_next_way(const followed_plan& plan) {
  const auto& g = plan.generation;
  const auto left = under_way(plan);
  if (!g.moved_to || (left && left == position_at(plan.map, *g.moved_to)))
    return false;
  const auto planned = left ? plan.map.items[*left].pictures : 0;
  return planned == 0 || (g.pictures.taken >= planned && is_on_next_line(plan));
}

// Where the pictures counted so far lead to. Nothing: no movement is left.
std::optional<std::uint32_t> end_of_way(const followed_plan& plan) {
  for (auto i = plan.generation.resolved; i < plan.map.items.size(); ++i)
    if (plan.map.items[i].last_nav_sequence)
      return i;
  return std::nullopt;
}

void count_now(decision_context& t, const std::optional<mission::vertex>& at) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  const bool is_next = is_of_next_way(plan);
  auto& pictures = is_next ? g.next_pictures : g.pictures;
  count_early_picture(g, pictures);
  const auto to = is_next ? position_at(plan.map, *g.moved_to) : end_of_way(plan);
  if (to && at && plan.map.items[*to].pictures > 0)
    t.s.mission->line = begun_line{.item_id = plan.map.items[*to].item_id, .at = *at, .pictures = pictures};
}

void judge_line(decision_context& t, const mapped_item& item, const mission::picture_count& pictures) {
  if (item.pictures == 0)
    return;
  if (t.s.last_picture && pictures.taken + std::max<std::uint32_t>(item.lines, 1) < item.pictures)
    tell(t, progress_event_kind::pictures_missing,
         "on the line to item '" + item.item_id + "' " + std::to_string(pictures.taken) + " pictures were taken of " +
             std::to_string(item.pictures) + " that the distance of its trigger gives");
  if (!t.s.last_picture && !std::exchange(t.s.is_unheard_told, true))
    tell(t, progress_event_kind::pictures_missing,
         "the vehicle reports no pictures (CAMERA_FEEDBACK or CAMERA_IMAGE_CAPTURED): it is not known whether the "
         "camera takes those of the mission");
}

} // namespace

act_kind act_of(const io::mavlink::mission_item_int& item, bool is_ardupilot) {
  switch (static_cast<mav_cmd>(item.command)) {
  case mav_cmd::do_gripper:
    return !is_ardupilot ? act_kind::none : item.param2 == 0 ? act_kind::release : act_kind::grab;
  case mav_cmd::nav_payload_place:
    return is_ardupilot ? act_kind::placement : act_kind::none;
  case mav_cmd::image_start_capture:
    return item.param3 == 1 ? act_kind::picture : act_kind::none;
  default:
    return act_kind::none;
  }
}

std::optional<act_told> act_in(std::string_view text) {
  if (text == "Gripper load released")
    return act_told{act_kind::release, act_outcome::confirmed, std::string(text)};
  if (text == "Gripper load grabbed")
    return act_told{act_kind::grab, act_outcome::confirmed, std::string(text)};
  if (text == "PayloadPlace: Reached maximum descent" || text == "PayloadPlace: Abort: Gripper Open")
    return act_told{act_kind::placement, act_outcome::failed, std::string(text)};
  return std::nullopt;
}

void take(decision_context& t, const act_told& what) {
  if (!counts(t))
    return;
  const auto position = act_reported(*t.s.plan, what.act);
  if (!position)
    return;
  resolve_act(t, {*position, what.outcome, {}}, "the vehicle reports \"" + what.text + "\"");
  go_on_if_known(t);
}

void take(decision_context& t, const picture_told& what) {
  const auto before = std::exchange(t.s.last_picture, what.index);
  if (before == what.index || !counts(t))
    return;
  auto& plan = *t.s.plan;
  if (const auto act = due_act(plan, act_kind::picture)) {
    resolve_act(t, {*act, what.is_good ? act_outcome::confirmed : act_outcome::failed, what.index},
                "the camera reports that it has taken no picture");
    return go_on_if_known(t);
  }
  if (!what.is_good)
    return;
  const auto since = before ? std::int64_t{what.index} - *before : 1;
  auto& g = plan.generation;
  count_early_picture(g, g.pictures);
  g.early = early_picture{
      what.index, since > 0 && since <= max_unheard_pictures ? static_cast<std::uint32_t>(since) : 1U, t.now_ns};
  const auto here = under_way(plan);
  if (g.moved_to || !here || plan.map.items[*here].pictures > 0 || !precedes_picture(plan.map, *here))
    count_now(t, what.at);
  go_on_if_known(t);
}

void adopt_early_picture(decision_context& t) {
  auto& g = t.s.plan->generation;
  if (!g.early)
    return;
  const auto act = due_act(*t.s.plan, act_kind::picture);
  if (!act && !is_on_next_line(*t.s.plan))
    return;
  if (is_over(g.early->at_ns, t.now_ns, reached_late_ns))
    return count_early_picture(g, g.pictures);
  if (!act)
    return count_early_picture(g, g.next_pictures);
  const auto early = *std::exchange(g.early, std::nullopt);
  g.acts.push_back({*act, act_outcome::confirmed, early.index});
  if (early.count > 1)
    count_pictures(g.pictures, early.index - 1, early.count - 1);
}

bool awaits_outcome(const followed_plan& plan, std::uint32_t position) {
  const auto& item = plan.map.items[position];
  return item.act != act_kind::none && item.role == item_role::acts && !is_known(plan, position);
}

bool awaits_outcome(const followed_plan& plan) {
  const auto& g = plan.generation;
  for (auto i = g.resolved; g.moved_to && i < plan.map.items.size() && is_passed(plan.map.items[i], *g.moved_to); ++i)
    if (awaits_outcome(plan, i))
      return true;
  return false;
}

std::int64_t outcomes_late_ns(const followed_plan& plan) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  std::int64_t latest_ns = 0;
  for (auto i = plan.generation.resolved; i < plan.map.items.size(); ++i)
    if (awaits_outcome(plan, i))
      latest_ns = std::max(latest_ns, plan.map.items[i].act_late_s * ns_per_s);
    else if (plan.map.items[i].last_nav_sequence > plan.generation.current)
      break;
  return outcome_late_ns + latest_ns;
}

bool awaits_last_picture(const followed_plan& plan) {
  const auto here = under_way(plan);
  if (!here)
    return false;
  const auto& line = plan.map.items[*here];
  const auto& pictures = plan.generation.pictures;
  return line.ends_with_picture && *line.last_nav_sequence == plan.generation.current && pictures.taken > 0 &&
         pictures.taken < line.pictures;
}

void begin_next_pictures(generation_state& g) {
  const auto next = std::exchange(g.next_pictures, {});
  g.pictures.taken += next.taken;
  g.pictures.first = g.pictures.first ? g.pictures.first : next.first;
  g.pictures.last = next.last ? next.last : g.pictures.last;
}

item_findings take_findings(decision_context& t, std::uint32_t position, mission::progress_kind kind) {
  auto& g = t.s.plan->generation;
  const auto& item = t.s.plan->map.items[position];
  item_findings result;
  if (const auto known = std::ranges::find(g.acts, position, &resolved_act::position); known != g.acts.end()) {
    result.outcome = known->outcome;
    if (known->picture)
      result.pictures = mission::picture_count{
          .taken = known->outcome == act_outcome::confirmed ? 1U : 0U, .first = known->picture, .last = known->picture};
    g.acts.erase(known);
  }
  if (auto& line = t.s.mission->line; line && line->item_id == item.item_id)
    line.reset();
  if (!item.last_nav_sequence || kind != mission::progress_kind::reached)
    return result;
  if (g.early && is_over(g.early->at_ns, t.now_ns, reached_late_ns))
    count_early_picture(g, g.pictures);
  auto pictures = std::exchange(g.pictures, {});
  judge_line(t, item, pictures);
  if (item.pictures > 0)
    pictures.planned = item.pictures;
  if (pictures.taken > 0 || (pictures.planned && t.s.last_picture))
    result.pictures = pictures;
  return result;
}

} // namespace godwit::executor::progress
