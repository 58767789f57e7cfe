// Plans that come in. See server.hpp.
#include <algorithm>

#include "actors/ground_port/mission_server/item_forms.hpp"
#include "actors/ground_port/mission_server/plan_check.hpp"
#include "actors/ground_port/mission_server/server.hpp"

namespace godwit::ground_port::mission_server {

using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using mavlink::sender;

void server::take(sender from, const mavlink::mission_count& m, std::int64_t now_ns) {
  if (is_busy_for(from) || is_closed_by_a_download()) {
    refuse_as_busy(from, m.mission_type, vehicle_.when_busy,
                   is_giving() ? occasion::count_while_read : occasion::count_while_written);
    return;
  }
  auto* upload = std::get_if<receiving>(&session_);
  if (upload != nullptr && vehicle_.when_count_comes_again == count_again::asks_again_before_item_1) {
    take_count_again(*upload, m, now_ns);
    return;
  }
  if (vehicle_.refused_count_ends_upload)
    end_session();
  if (m.count == 0) {
    clear(from, m.mission_type, occasion::cleared_by_count);
  } else if (!is_one_type(m.mission_type)) {
    acknowledge(from, m.mission_type,
                vehicle_.checks_type ? mav_mission_result::unsupported : mav_mission_result::no_space);
  } else if (m.count > vehicle_.capacity) {
    acknowledge(from, m.mission_type, mav_mission_result::no_space);
    say(occasion::no_space, {.type = m.mission_type, .who = from, .count = m.count});
  } else {
    const auto type = static_cast<mav_mission_type>(m.mission_type);
    store_.begin(type, m.count);
    if (!store_.is_staged(type))
      note_change(plan_change_kind::begun_replacing, type, from);
    begin(from, type, 0, m.count, now_ns);
  }
}

// The vehicle takes it for a repeated one, whatever it counts.
void server::take_count_again(receiving& upload, const mavlink::mission_count& m, std::int64_t now_ns) {
  upload.heard_ns = now_ns;
  if (upload.wanted == 0)
    ask(upload, now_ns);
  else
    refuse_as_busy(upload.from, m.mission_type, vehicle_.when_busy, occasion::count_again);
}

void server::take(sender from, const mavlink::mission_write_partial_list& m, std::int64_t now_ns) {
  if (vehicle_.when_partial == partial_list::ignored)
    return;
  if (vehicle_.when_partial == partial_list::unsupported || !is_one_type(m.mission_type)) {
    acknowledge(from, m.mission_type, mav_mission_result::unsupported);
    return;
  }
  if (is_busy_for(from) || is_receiving() || is_closed_by_a_download()) {
    refuse_as_busy(from, m.mission_type, vehicle_.when_busy, occasion::count_while_written);
    return;
  }
  const auto type = static_cast<mav_mission_type>(m.mission_type);
  const auto held = static_cast<int>(store_.plan(type).items.size());
  // One after the last is added to it.
  const bool is_in_the_plan = m.start_index >= 0 && m.end_index >= m.start_index && m.end_index <= held;
  if (!is_in_the_plan || m.end_index >= vehicle_.capacity) {
    acknowledge(from, m.mission_type, mav_mission_result::error);
    say(occasion::partial_list_refused, {.type = m.mission_type, .who = from});
    return;
  }
  store_.begin_in_part(type);
  begin(from, type, m.start_index, m.end_index + 1, now_ns);
}

void server::begin(sender from, mav_mission_type type, int first, int count, std::int64_t now_ns) {
  finished_.reset();
  auto& upload = session_.emplace<receiving>(
      receiving{from, type, count, first, now_ns, now_ns, vehicle_.asks_with, {vehicle_.fence, count}, {}});
  // What waits already is taken before it asks: if that is the first item, there is no request for it.
  if (inbox_.is_empty())
    ask(upload, now_ns);
  else
    upload.asked_ns = now_ns + vehicle_.turn_ns - vehicle_.asks_again_ns;
}

void server::take(sender from, const mavlink::mission_item_int& m, std::int64_t now_ns) {
  auto* upload = std::get_if<receiving>(&session_);
  if (upload == nullptr || upload->from != from) {
    take_stray(from, m);
    return;
  }
  upload->heard_ns = now_ns;
  if (m.mission_type != number(upload->type)) {
    acknowledge(from, m.mission_type, mav_mission_result::error);
    return;
  }
  if (m.seq == upload->wanted) {
    take_wanted(*upload, m, now_ns);
    return;
  }
  switch (vehicle_.when_out_of_order) {
  case out_of_order::ignored:
    return;
  case out_of_order::acknowledged_as_error:
    acknowledge(from, m.mission_type, mav_mission_result::invalid_sequence);
    return;
  case out_of_order::asked_for_again:
    ask(*upload, now_ns);
    return;
  }
}

void server::take(sender from, const mavlink::mission_item& m, std::int64_t now_ns) {
  if (!vehicle_.takes_float_items)
    return;
  if (auto* upload = std::get_if<receiving>(&session_); upload != nullptr && upload->from == from)
    upload->asks_with = request_kind::mission_request;
  say(occasion::float_item, {.type = m.mission_type, .who = from});
  take(from, in_integers(m), now_ns);
}

void server::take_stray(sender from, const mavlink::mission_item_int& m) {
  if (partner() && partner() != from) {
    take_foreign(from, m);
    return;
  }
  const bool is_last_again = is_idle() && finished_ && finished_->from == from &&
                             number(finished_->type) == m.mission_type && m.seq == finished_->last;
  if (is_last_again) {
    if (vehicle_.when_last_item_comes_again == last_item_again::accepted_again)
      acknowledge(from, m.mission_type, mav_mission_result::accepted, store_.plan(finished_->type).id);
    else if (vehicle_.when_last_item_comes_again == last_item_again::error)
      acknowledge(from, m.mission_type, mav_mission_result::error);
  } else if (vehicle_.when_no_transfer == stray_item::error) {
    acknowledge(from, m.mission_type, mav_mission_result::error);
    say(is_giving() ? occasion::item_while_read : occasion::item_without_upload,
        {.type = m.mission_type, .who = from, .item = m.seq});
  }
}

void server::take_foreign(sender from, const mavlink::mission_item_int& m) {
  const auto* upload = std::get_if<receiving>(&session_);
  const bool is_the_wanted_one = upload != nullptr && upload->wanted == m.seq;
  const bool is_by_order = vehicle_.when_item_is_foreign == foreign_item::by_order && upload != nullptr;
  if (is_by_order)
    acknowledge(from, m.mission_type,
                is_the_wanted_one ? mav_mission_result::denied : mav_mission_result::invalid_sequence);
  else if (vehicle_.when_item_is_foreign != foreign_item::ignored)
    acknowledge(from, m.mission_type, mav_mission_result::error);
  say(occasion::foreign_item, {.type = m.mission_type, .who = from, .item = m.seq});
}

void server::take_wanted(receiving& upload, const mavlink::mission_item_int& m, std::int64_t now_ns) {
  auto verdict = check_item(m, vehicle_);
  auto fault = occasion::item_refused;
  const bool is_fence_to_judge = upload.type == mav_mission_type::fence && !vehicle_.fence.judges_at_the_end;
  if (verdict == mav_mission_result::accepted && is_fence_to_judge && !upload.fence.takes(m)) {
    verdict = vehicle_.fence.refusal;
    fault = occasion::fence_refused;
  }
  if (verdict != mav_mission_result::accepted) {
    acknowledge(upload.from, m.mission_type, verdict);
    say(fault, {.type = m.mission_type, .who = upload.from, .item = m.seq, .reason = verdict});
    end_session();
    return;
  }
  store_.put(m);
  if (upload.type == mav_mission_type::mission && m.current == 1)
    upload.marked_current = m.seq;
  ++upload.wanted;
  if (upload.wanted < upload.count)
    ask(upload, now_ns);
  else
    finish(upload);
}

void server::finish(const receiving& ended) {
  const auto upload = ended; // it is in the session, which ends here
  const auto type = number(upload.type);
  if (const auto fault = fault_of_the_whole(upload)) {
    acknowledge(upload.from, type, vehicle_.fence.refusal);
    say(occasion::fence_refused, {.type = type, .who = upload.from, .item = *fault});
    end_session();
    return;
  }
  const bool is_the_same = store_.complete();
  end_session();
  finished_ = {upload.from, upload.type, upload.count - 1};
  const auto& plan = store_.plan(upload.type);
  acknowledge(upload.from, type, mav_mission_result::accepted, plan.id);
  note_change(plan_change_kind::replaced, upload.type, upload.from);
  out_.changes.back().marked_current = upload.marked_current;
  out_.changes.back().identical = is_the_same;
  say(occasion::plan_received, {.type = type, .who = upload.from, .count = static_cast<int>(plan.items.size())});
}

// Of a fence that is judged at its end: the item which makes it none.
std::optional<int> server::fault_of_the_whole(const receiving& upload) const {
  if (upload.type != mav_mission_type::fence || !vehicle_.fence.judges_at_the_end)
    return std::nullopt;
  const auto& items = store_.incoming();
  fence_check fence(vehicle_.fence, static_cast<int>(items.size()));
  const auto fault = std::find_if(items.begin(), items.end(), [&](const auto& each) { return !fence.takes(each); });
  return fault == items.end() ? std::nullopt : std::optional<int>(fault->seq);
}

void server::give_up_upload(const receiving& upload) {
  const auto type = number(upload.type);
  if (vehicle_.when_giving_up == giving_up::tells)
    acknowledge(upload.from, type, mav_mission_result::operation_cancelled);
  say(occasion::upload_timed_out, {.type = type, .who = upload.from, .item = upload.wanted});
  end_session();
}

void server::ask_again(receiving& upload, std::int64_t now_ns) {
  using enum request_kind;
  if (vehicle_.asks_in_both_ways)
    upload.asks_with = upload.asks_with == mission_request ? mission_request_int : mission_request;
  ask(upload, now_ns);
}

void server::ask(receiving& upload, std::int64_t now_ns) {
  upload.asked_ns = now_ns;
  const auto ask_with = [&](auto request) {
    request.seq = static_cast<std::uint16_t>(upload.wanted);
    request.mission_type = number(upload.type);
    send(upload.from, request);
  };
  if (upload.asks_with == request_kind::mission_request)
    ask_with(mavlink::mission_request{});
  else
    ask_with(mavlink::mission_request_int{});
}

} // namespace godwit::ground_port::mission_server
