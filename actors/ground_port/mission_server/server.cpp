#include "actors/ground_port/mission_server/server.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/ground_port/mission_server/item_check.hpp"
#include "actors/ground_port/mission_server/item_forms.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using mavlink::sender;

constexpr mav_mission_type all_types[] = {mav_mission_type::mission, mav_mission_type::fence, mav_mission_type::rally};

bool is_one_type(std::uint8_t type) { return type <= number(mav_mission_type::rally); }

} // namespace

server::server(const habits& vehicle, sender ourselves)
    : vehicle_(vehicle), ourselves_(ourselves), inbox_(vehicle.turn_ns), store_(vehicle) {}

reaction server::on(sender from, const incoming& what, std::int64_t now_ns) {
  const bool concerns_us = std::visit([this](const auto& m) { return is_for_us(m); }, what);
  if (!concerns_us)
    return {};
  inbox_.put({from, what}, now_ns);
  return on_time(now_ns);
}

reaction server::on_time(std::int64_t now_ns) {
  out_ = {};
  while (const auto each = inbox_.take(now_ns))
    take(*each, now_ns);
  on_silence(now_ns);
  return std::exchange(out_, {});
}

std::int64_t server::next_deadline_ns() const {
  auto result = inbox_.next_turn_ns();
  if (const auto* upload = std::get_if<receiving>(&session_))
    result = std::min({result, upload->asked_ns + vehicle_.asks_again_ns, upload->heard_ns + vehicle_.gives_up_ns});
  if (const auto* download = std::get_if<giving>(&session_))
    result = std::min(result, download->heard_ns + vehicle_.gives_up_ns);
  return result;
}

void server::restart() {
  inbox_ = inbox(vehicle_.turn_ns);
  store_.discard();
  session_ = idle{};
  finished_.reset();
}

void server::on_silence(std::int64_t now_ns) {
  if (auto* upload = std::get_if<receiving>(&session_)) {
    if (now_ns - upload->heard_ns >= vehicle_.gives_up_ns) {
      if (vehicle_.when_giving_up == giving_up::tells)
        acknowledge(upload->from, number(upload->type), mav_mission_result::operation_cancelled);
      store_.discard();
      session_ = idle{};
    } else if (now_ns - upload->asked_ns >= vehicle_.asks_again_ns) {
      ask(*upload, now_ns);
    }
  } else if (const auto* download = std::get_if<giving>(&session_)) {
    if (now_ns - download->heard_ns >= vehicle_.gives_up_ns)
      session_ = idle{};
  }
}

void server::take(const letter& each, std::int64_t now_ns) {
  std::visit([&](const auto& m) { take(each.from, m, now_ns); }, each.what);
}

void server::take(sender from, const mavlink::mission_count& m, std::int64_t now_ns) {
  const auto* upload = std::get_if<receiving>(&session_);
  const bool is_too_late = upload != nullptr && upload->wanted > 0 &&
                           vehicle_.when_count_comes_again == count_again::begins_again_before_item_1;
  if (is_busy_for(from) || is_too_late || (is_giving() && vehicle_.is_busy_while_read)) {
    refuse_as_busy(from, m.mission_type);
    return;
  }
  if (m.count == 0) {
    clear(from, m.mission_type);
    return;
  }
  if (!is_one_type(m.mission_type)) {
    acknowledge(from, m.mission_type, mav_mission_result::unsupported);
    return;
  }
  if (m.count > vehicle_.capacity) {
    acknowledge(from, m.mission_type, mav_mission_result::no_space);
    return;
  }
  const auto type = static_cast<mav_mission_type>(m.mission_type);
  finished_.reset();
  store_.begin(type, m.count);
  session_ = receiving{from, type, m.count, 0, now_ns, now_ns, vehicle_.asks_with};
  ask(std::get<receiving>(session_), now_ns);
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
  take(from, in_integers(m), now_ns);
}

void server::take_stray(sender from, const mavlink::mission_item_int& m) {
  const bool is_last_again = finished_ && finished_->from == from && number(finished_->type) == m.mission_type &&
                             m.seq == finished_->count - 1 && is_idle();
  if (is_last_again) {
    if (vehicle_.when_last_item_comes_again == last_item_again::accepted_again)
      acknowledge(from, m.mission_type, mav_mission_result::accepted, store_.plan(finished_->type).id);
    else if (vehicle_.when_last_item_comes_again == last_item_again::error)
      acknowledge(from, m.mission_type, mav_mission_result::error);
  } else if (vehicle_.when_no_transfer == stray_item::error) {
    acknowledge(from, m.mission_type, mav_mission_result::error);
  }
}

void server::take_wanted(receiving& upload, const mavlink::mission_item_int& m, std::int64_t now_ns) {
  const auto verdict = check_item(m, vehicle_);
  if (verdict != mav_mission_result::accepted) {
    acknowledge(upload.from, m.mission_type, verdict);
    store_.discard();
    session_ = idle{};
    return;
  }
  store_.put(m);
  ++upload.wanted;
  if (upload.wanted < upload.count) {
    ask(upload, now_ns);
    return;
  }
  store_.complete();
  finished_ = upload;
  session_ = idle{};
  acknowledge(finished_->from, m.mission_type, mav_mission_result::accepted, store_.plan(finished_->type).id);
  note_change(finished_->type, finished_->from);
}

void server::take(sender from, const mavlink::mission_request_list& m, std::int64_t now_ns) {
  if (is_busy_for(from) || is_receiving()) {
    refuse_as_busy(from, m.mission_type);
    return;
  }
  if (!is_one_type(m.mission_type)) {
    acknowledge(from, m.mission_type, mav_mission_result::unsupported);
    return;
  }
  const auto type = static_cast<mav_mission_type>(m.mission_type);
  session_ = giving{from, type, 0, now_ns};
  const auto& plan = store_.plan(type);
  mavlink::mission_count answer;
  answer.mission_type = m.mission_type;
  answer.count = static_cast<std::uint16_t>(plan.items.size());
  answer.opaque_id = plan.id;
  send(from, answer);
}

void server::take(sender from, const mavlink::mission_request_int& m, std::int64_t now_ns) {
  if (const auto item = item_for(from, m.mission_type, m.seq, now_ns))
    send(from, *item);
}

void server::take(sender from, const mavlink::mission_request& m, std::int64_t now_ns) {
  if (!vehicle_.serves_float_items)
    acknowledge(from, m.mission_type, mav_mission_result::unsupported);
  else if (const auto item = item_for(from, m.mission_type, m.seq, now_ns))
    send(from, in_floats(*item));
}

// Nothing: it is not there, or not its turn; where the vehicle says so, that has been sent.
std::optional<mavlink::mission_item_int> server::item_for(sender to, std::uint8_t type, int seq, std::int64_t now_ns) {
  auto* download = std::get_if<giving>(&session_);
  const bool is_theirs = download != nullptr && download->to == to && number(download->type) == type;
  if (!is_one_type(type) || (!is_theirs && !vehicle_.serves_any_item))
    return std::nullopt;
  const auto& items = store_.plan(static_cast<mav_mission_type>(type)).items;
  if (static_cast<std::size_t>(seq) >= items.size()) {
    if (vehicle_.serves_any_item)
      acknowledge(to, type, mav_mission_result::invalid_sequence);
    return std::nullopt;
  }
  if (is_theirs) {
    const bool is_its_turn = seq == download->next || seq == download->next - 1;
    if (!is_its_turn && !vehicle_.serves_any_item)
      return std::nullopt;
    download->next = seq + 1;
    download->heard_ns = now_ns;
  }
  auto item = items[static_cast<std::size_t>(seq)];
  item.seq = static_cast<std::uint16_t>(seq);
  item.mission_type = type;
  if (vehicle_.marks_first_as_current && type == number(mav_mission_type::mission))
    item.current = seq == 0 ? 1 : 0;
  return item;
}

void server::take(sender from, const mavlink::mission_ack& m, std::int64_t /*now_ns*/) {
  if (const auto* download = std::get_if<giving>(&session_)) {
    if (download->to == from)
      session_ = idle{};
  } else if (const auto* upload = std::get_if<receiving>(&session_)) {
    const bool is_cancel = m.type == number(mav_mission_result::operation_cancelled);
    if (upload->from != from || !is_cancel || !vehicle_.obeys_cancel)
      return;
    store_.discard();
    session_ = idle{};
  }
}

void server::take(sender from, const mavlink::mission_clear_all& m, std::int64_t /*now_ns*/) {
  if (is_busy_for(from) || is_receiving() || (is_giving() && vehicle_.is_busy_while_read))
    refuse_as_busy(from, m.mission_type);
  else
    clear(from, m.mission_type);
}

void server::clear(sender from, std::uint8_t type) {
  const bool is_all = type == number(mav_mission_type::all);
  if (is_all ? !vehicle_.clears_all_types_at_once : !is_one_type(type)) {
    acknowledge(from, type,
                vehicle_.checks_type || is_all ? mav_mission_result::unsupported : mav_mission_result::accepted);
    return;
  }
  if (is_locked_ && (is_all || type == number(mav_mission_type::mission))) {
    acknowledge(from, type, mav_mission_result::denied);
    return;
  }
  finished_.reset();
  session_ = idle{};
  for (const auto each : all_types) {
    if (!is_all && number(each) != type)
      continue;
    store_.clear(each);
    note_change(each, from);
  }
  acknowledge(from, type, mav_mission_result::accepted);
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

void server::acknowledge(sender to, std::uint8_t type, mav_mission_result result, std::uint32_t id) {
  mavlink::mission_ack ack;
  ack.type = number(result);
  ack.mission_type = type;
  ack.opaque_id = id;
  send(to, ack);
}

void server::refuse_as_busy(sender to, std::uint8_t type) {
  if (vehicle_.when_busy)
    acknowledge(to, type, *vehicle_.when_busy);
}

void server::note_change(mav_mission_type type, sender by) {
  const auto& plan = store_.plan(type);
  out_.changes.push_back({type, plan.id, static_cast<int>(plan.items.size()), by});
}

template <class M>
void server::send(sender to, M message) {
  message.target_system = to.system;
  message.target_component = to.component;
  out_.messages.emplace_back(message);
}

template <class M>
bool server::is_for_us(const M& m) const {
  if (m.target_system == ourselves_.system && m.target_component == ourselves_.component)
    return true;
  return vehicle_.listens_to_everybody && (m.target_system == 0 || m.target_system == ourselves_.system);
}

bool server::is_busy_for(sender station) const {
  if (const auto* upload = std::get_if<receiving>(&session_))
    return upload->from != station;
  const auto* download = std::get_if<giving>(&session_);
  return download != nullptr && download->to != station && vehicle_.is_busy_while_read;
}

} // namespace godwit::ground_port::mission_server
