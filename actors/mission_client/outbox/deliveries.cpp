#include "actors/mission_client/outbox/deliveries.hpp"

#include <algorithm>
#include <array>

#include "actors/domain/mission/read.hpp"
#include "actors/mission_client/calls.hpp"
#include "actors/mission_client/changes.hpp"
#include "actors/mission_client/outbox/keys.hpp"

namespace godwit::mission_client {

namespace {

std::string kind_of(destination to) { return std::string(delivering).append(io::name_of(to)); }

// The lane's rows that wait, from the one with this key on.
std::vector<std::string> all_after(const state& s, const std::string& key) {
  std::vector<std::string> result;
  if (const auto* first = find_row(s.rows, key))
    for (const auto* each : cut_from(s.rows, *first, s.rows.size()))
      result.push_back(each->key);
  return result;
}

// A call into silence must not keep the next one waiting; a long body gets the time that it needs on a slow line.
std::chrono::milliseconds flown_timeout(std::size_t bytes) {
  constexpr std::size_t slowest_bytes_per_s = 16'384;
  return std::chrono::ceil<std::chrono::milliseconds>(std::chrono::nanoseconds(change_window_ns)) +
         std::chrono::seconds(bytes / slowest_bytes_per_s);
}

store::destination destination_of(destination to) {
  return to == destination::observations ? store::destination::observations : store::destination::ignored_items;
}

} // namespace

// -- what is to be done ---------------------------------------------------------------------------

deliveries::heads deliveries::heads_of(const state& s) {
  heads result;
  const outbox_row* last = nullptr; // most rows are of the same lane as the one before
  for (const auto& each : s.rows) {
    if (each.state != row_state::pending)
      continue;
    if (last == nullptr || last->to != each.to || last->mission_id != each.mission_id)
      result.try_emplace({each.to, each.mission_id}, &each);
    last = &each;
  }
  return result;
}

void deliveries::plan(planning_context& d) {
  const auto known = heads_of(d.s);
  for (const auto& [id, head] : known)
    plan_lane(d, lanes_[id], *head);
  for (const auto& each : d.s.rows) // one that stands in its lane after another has its time, too
    if (is_waited_for(each) && known.at({each.to, each.mission_id}) != &each)
      static_cast<void>(is_too_late(d, each));
  plan_batches(d, known);
  std::erase_if(lanes_, [&](const auto& each) { return each.second.waiting == 0 && !known.contains(each.first); });
  for (const auto& [to, name] : io::enum_table<destination>)
    if (std::ranges::none_of(lanes_, [&](const auto& each) { return each.first.first == to; }))
      d.went_well(kind_of(to));
}

void deliveries::plan_lane(planning_context& d, lane& l, const outbox_row& head) {
  if (is_waited_for(head) && is_too_late(d, head)) {
    if (l.waiting != 0)
      d.cancel(std::exchange(l.waiting, 0));
    return;
  }
  if (l.waiting != 0 || l.is_blocked || head.order >= std::min(on_disk_below_, held_back_from(d.s.rows, head)))
    return;
  if (head.to == destination::progress && asks_progress(d.s, head.mission_id))
    return; // its number is not sure yet
  if (head.to == destination::picture && is_in_flight(d.s, head.mission_id))
    return; // reports and the map come first
  if (!is_due(head.next_try_ns, d.now.wall_ns))
    return d.wake_at_wall(head.next_try_ns);
  if (d.now.monotonic_ns < l.not_before_ns)
    return d.wake_at(l.not_before_ns);
  if (is_change(head.to) || under_way() < max_deliveries_under_way)
    start(d, l, head);
}

// Its two seconds are over, in this life or an earlier one.
bool deliveries::is_too_late(planning_context& d, const outbox_row& change) {
  const auto deadline_ns = change.created_ns + change_window_ns;
  if (d.now.wall_ns < deadline_ns) {
    d.wake_at_wall(deadline_ns);
    return false;
  }
  d.happened(change_failed{change.key, change_verdict::unknown, "the service did not answer within 2 s"});
  return true;
}

// One batch at a time for each lane: what is after it stays in the store until then.
void deliveries::plan_batches(planning_context& d, const heads& known) {
  for (const auto& note : d.s.missions)
    for (const auto to : {destination::observations, destination::ignored_items})
      if (note.is_pushing && !note.is_done(to) && !known.contains({to, note.mission_id}) && !is_full(d.s.rows))
        d.happened(batch_planned{fresh_key(d.random), note.mission_id, to});
}

void deliveries::start(planning_context& d, lane& l, const outbox_row& head) {
  if (is_map(head.to) && head.goes_back) {
    l.is_at_service = false;
    l.keys = {head.key};
    return ask(d, l, store::return_batch{head.key});
  }
  if (is_map(head.to)) {
    const auto* note = find_note(d.s, head.mission_id);
    const auto smaller = note == nullptr ? 0 : note->limit(head.to);
    const auto limit = smaller == 0 ? d.set.batch_limit : std::min(smaller, d.set.batch_limit);
    const bool same = l.keys.size() == 1 && l.keys.front() == head.key;
    l.is_at_service = l.is_at_service && same;
    l.keys = {head.key};
    if (l.is_at_service)
      return ask(d, l, store::batch_delivered{head.key});
    return ask(d, l, store::take_batch{head.key, head.mission_id, destination_of(head.to), limit});
  }
  const auto cut = cut_from(d.s.rows, head, head.to == destination::progress ? reports_per_call : 1);
  const auto below = std::min(on_disk_below_, held_back_from(d.s.rows, head));
  l.keys.clear();
  for (const auto* each : cut)
    if (each->order < below)
      l.keys.push_back(each->key);
  const std::vector<const outbox_row*> rows(cut.begin(), cut.begin() + static_cast<std::ptrdiff_t>(l.keys.size()));
  auto call = head.to == destination::progress ? post_progress(d.set, rows) : post_row(d.set, head);
  if (is_waited_for(head)) {
    const auto left_ns = head.created_ns + change_window_ns - d.now.wall_ns;
    const std::chrono::nanoseconds left(std::min(left_ns, change_window_ns)); // the clock may have been set meanwhile
    call.total_timeout = std::max(std::chrono::ceil<std::chrono::milliseconds>(left), std::chrono::milliseconds(1));
    call.read_timeout = call.total_timeout;
  } else if (head.is_flown) {
    call.total_timeout = call.read_timeout = flown_timeout(head.body.size());
  }
  post(d, l, std::move(call));
}

void deliveries::post(planning_context& d, lane& l, service_call call) {
  l.waiting = d.call(*this, std::move(call));
  l.is_call = true;
}

void deliveries::ask(planning_context& d, lane& l, store_question what) {
  l.waiting = d.ask(*this, std::move(what));
  l.is_call = false;
}

std::size_t deliveries::under_way() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      lanes_, [](const auto& each) { return each.second.waiting != 0 && !is_change(each.first.first); }));
}

// -- answers of the service -----------------------------------------------------------------------

std::map<deliveries::lane_id, deliveries::lane>::iterator deliveries::end_wait(ticket number) {
  const auto found = std::ranges::find_if(lanes_, [&](const auto& each) { return each.second.waiting == number; });
  if (found != lanes_.end())
    found->second.waiting = 0;
  return found;
}

void deliveries::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  const auto found = end_wait(number);
  if (found == lanes_.end())
    return;
  auto& [id, l] = *found;
  if (!is_change(id.first))
    return take_row_answer(d, id, l, answer);
  if (const auto* row = find_row(d.s.rows, l.keys.front()))
    d.happened(outcome_of_change(*row, answer, d.now.wall_ns));
}

void deliveries::take_row_answer(planning_context& d, const lane_id& id, lane& l, const service_answer& answer) {
  const auto why = judge(answer) == judgement::success ? std::string() : sentence_of(answer);
  switch (judge(answer)) {
  case judgement::success:
    return take_receipt(d, id, l, answer);
  case judgement::gone:
    return d.happened(mission_gone{id.second});
  case judgement::not_found:
    return d.happened(rows_refused{all_after(d.s, l.keys.front()), why, true, 0});
  case judgement::conflict:
    if (is_map(id.first))
      return d.happened(rows_refused{l.keys, why, false, l.batch_rows});
    // With a report all that come after it are refused too.
    return d.happened(rows_refused{all_after(d.s, l.keys.front()), why, false, 0});
  case judgement::wrong:
    return d.happened(rows_refused{l.keys, why, false, is_map(id.first) ? l.batch_rows : 0});
  case judgement::not_allowed:
    l.is_blocked = true;
    break;
  default:
    break;
  }
  fail(d, id, l, why, answer);
}

// A portal on the way can answer 200 as well: only a receipt counts.
void deliveries::take_receipt(planning_context& d, const lane_id& id, lane& l, const service_answer& answer) {
  if (const auto receipt = mission::read<mission::receipt>(answer.body); !receipt)
    return fail(d, id, l, "what the service sent is no receipt: " + receipt.error().message(), answer);
  l.failed = 0;
  d.went_well(kind_of(id.first));
  if (!is_map(id.first))
    return d.happened(rows_delivered{l.keys});
  l.is_at_service = true;
  ask(d, l, store::batch_delivered{l.keys.front()});
}

void deliveries::fail(planning_context& d, const lane_id& id, lane& l, const std::string& why,
                      const service_answer& answer) {
  ++l.failed;
  d.went_wrong(kind_of(id.first), why);
  d.happened(rows_failed{l.keys, cut_error(why), answer.retry_after_ns.value_or(0)});
}

// -- answers of the map store ---------------------------------------------------------------------

void deliveries::on_store(planning_context& d, ticket number, const store_answer& answer) {
  const auto found = end_wait(number);
  if (found == lanes_.end())
    return;
  auto& [id, l] = *found;
  if (failure_of(answer) != store::map_failure::none)
    return take_store_failure(d, id, l, answer);
  l.store_failed = 0;
  const auto* row = find_row(d.s.rows, l.keys.front());
  if (const auto* rows = std::get_if<store::batch>(&answer)) {
    take_batch(d, l, *rows);
  } else if (row != nullptr && row->goes_back) {
    l.batch_rows = 0;
    d.happened(batch_returned{l.keys.front()});
  } else if (l.is_at_service) {
    l.is_at_service = false;
    l.batch_rows = 0;
    d.happened(rows_delivered{l.keys});
  }
}

void deliveries::take_batch(planning_context& d, lane& l, const store::batch& rows) {
  l.batch_rows = static_cast<std::uint32_t>(rows.observations.size() + rows.ignored_items.size());
  if (l.batch_rows == 0)
    d.happened(batch_empty{l.keys.front()});
  else
    post(d, l, post_batch(d.set, rows));
}

void deliveries::take_store_failure(planning_context& d, const lane_id& id, lane& l, const store_answer& answer) {
  switch (failure_of(answer)) {
  case store::map_failure::delivered: // under this key, in an earlier life
    return d.happened(rows_delivered{l.keys});
  case store::map_failure::refused:
    return d.happened(rows_refused{l.keys, sentence_of(answer), true, 0});
  default:
    break;
  }
  ++l.store_failed;
  l.not_before_ns = d.now.monotonic_ns + pause_ns(l.store_failed, l.keys.front());
  d.went_wrong(kind_of(id.first), sentence_of(answer));
}

// -- what others want to know ---------------------------------------------------------------------

void deliveries::free() {
  for (auto& [id, l] : lanes_) {
    l.is_blocked = false;
    l.not_before_ns = 0;
  }
}

void deliveries::count_anew() {
  for (auto& [id, l] : lanes_)
    l.failed = 0;
}

bool deliveries::has_tried_enough(destination to, const std::string& mission_id, int tries) const {
  const auto found = lanes_.find({to, mission_id});
  if (found == lanes_.end())
    return false;
  const auto enough = static_cast<std::uint32_t>(tries);
  return found->second.is_blocked || found->second.failed >= enough || found->second.store_failed >= enough;
}

std::size_t deliveries::blocked() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(lanes_, [](const auto& each) { return each.second.is_blocked; }));
}

bool deliveries::is_blocked(const std::string& mission_id) const {
  return std::ranges::any_of(
      lanes_, [&](const auto& each) { return each.second.is_blocked && each.first.second == mission_id; });
}

std::uint32_t deliveries::rows_in_batches() const {
  std::uint32_t result = 0;
  for (const auto& [id, l] : lanes_)
    result += l.batch_rows;
  return result;
}

} // namespace godwit::mission_client
