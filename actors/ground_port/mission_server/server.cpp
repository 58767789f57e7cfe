#include "actors/ground_port/mission_server/server.hpp"

#include <algorithm>
#include <utility>

namespace godwit::ground_port::mission_server {

using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using mavlink::sender;

server::server(const server_profile& vehicle, sender ourselves)
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

void server::put_plan(mav_mission_type type, std::vector<mavlink::mission_item_int> items) {
  // Who reads it would get the beginning of the one and the rest of the other.
  if (const auto* download = std::get_if<giving>(&session_); download != nullptr && download->type == type)
    end_session();
  store_.restore(type, std::move(items));
  finished_.reset();
}

void server::restart() {
  inbox_ = inbox(vehicle_.turn_ns);
  end_session();
  finished_.reset();
  said_once_ = 0;
}

std::optional<sender> server::partner() const {
  if (const auto* upload = std::get_if<receiving>(&session_))
    return upload->from;
  if (const auto* download = std::get_if<giving>(&session_))
    return download->to;
  return std::nullopt;
}

void server::on_silence(std::int64_t now_ns) {
  if (auto* upload = std::get_if<receiving>(&session_)) {
    if (now_ns - upload->heard_ns >= vehicle_.gives_up_ns)
      give_up_upload(*upload);
    else if (now_ns - upload->asked_ns >= vehicle_.asks_again_ns)
      ask_again(*upload, now_ns);
  } else if (const auto* download = std::get_if<giving>(&session_)) {
    if (now_ns - download->heard_ns < vehicle_.gives_up_ns)
      return;
    say(occasion::download_timed_out, {.type = number(download->type), .who = download->to});
    end_session();
  }
}

void server::end_session() {
  store_.discard();
  session_ = idle{};
}

void server::take(const letter& each, std::int64_t now_ns) {
  std::visit([&](const auto& m) { take(each.from, m, now_ns); }, each.what);
}

void server::take(sender from, const mavlink::mission_ack& m, std::int64_t /*now_ns*/) {
  if (partner() != from)
    return;
  if (const auto* download = std::get_if<giving>(&session_)) {
    if (number(download->type) == m.mission_type)
      end_session();
  } else if (m.type == number(mav_mission_result::operation_cancelled) && vehicle_.obeys_cancel) {
    say(occasion::upload_cancelled, {.type = number(std::get<receiving>(session_).type), .who = from});
    end_session();
  }
}

void server::take(sender from, const mavlink::mission_clear_all& m, std::int64_t /*now_ns*/) {
  if (is_busy_for(from) || is_receiving() || is_closed_by_a_download())
    refuse_as_busy(from, m.mission_type, vehicle_.when_clear_is_refused, occasion::clear_while_busy);
  else
    clear(from, m.mission_type, occasion::cleared);
}

void server::clear(sender from, std::uint8_t type, occasion by) {
  const bool is_all = type == number(mav_mission_type::all);
  if (is_all ? !vehicle_.clears_all_types_at_once : !is_one_type(type)) {
    acknowledge(from, type,
                vehicle_.checks_type || is_all ? mav_mission_result::unsupported : mav_mission_result::accepted);
    return;
  }
  const auto refusal = by == occasion::cleared ? vehicle_.when_cleared_in_flight : vehicle_.when_counted_0_in_flight;
  if (is_locked_ && refusal && (is_all || type == number(mav_mission_type::mission))) {
    acknowledge(from, type, *refusal);
    say(occasion::clear_refused, {.type = type, .who = from});
    return;
  }
  finished_.reset();
  end_session();
  for (const auto each : {mav_mission_type::mission, mav_mission_type::fence, mav_mission_type::rally}) {
    if (!is_all && number(each) != type)
      continue;
    store_.clear(each);
    note_change(plan_change_kind::cleared, each, from);
  }
  acknowledge(from, type, mav_mission_result::accepted);
  say(by, {.type = type, .who = from});
}

void server::acknowledge(sender to, std::uint8_t type, mav_mission_result result, std::uint32_t id) {
  mavlink::mission_ack ack;
  ack.type = number(result);
  ack.mission_type = type;
  ack.opaque_id = id;
  send(to, ack);
}

void server::refuse_as_busy(sender to, std::uint8_t type, std::optional<mav_mission_result> result, occasion when) {
  if (result)
    acknowledge(to, type, *result);
  say(when, {.type = type, .who = to, .whom = partner().value_or(to)});
}

void server::note_change(plan_change_kind kind, mav_mission_type type, sender by) {
  const auto& plan = store_.plan(type);
  if (type == mav_mission_type::mission && kind != plan_change_kind::begun_replacing)
    current_ = 0;
  out_.changes.push_back({kind, type, plan.id, static_cast<int>(plan.items.size()), by, {}, false});
}

void server::say(occasion when, text_facts facts) {
  for (const auto& row : vehicle_.texts) {
    if (row.when != when || (row.type && number(*row.type) != facts.type))
      continue;
    const auto bit = std::uint32_t{1} << static_cast<unsigned>(when);
    if (row.once && (said_once_ & bit) != 0)
      return;
    said_once_ |= bit;
    facts.room = vehicle_.capacity;
    out_.texts.push_back({number(row.severity), filled(row.text, facts)});
    return;
  }
}

template <class M>
bool server::is_for_us(const M& m) const {
  if (m.target_system == ourselves_.system && m.target_component == ourselves_.component)
    return true;
  switch (vehicle_.accepts) {
  case accepted_address::own_address:
    return false;
  case accepted_address::component_0_too:
    return m.target_system == ourselves_.system && m.target_component == 0;
  case accepted_address::everything:
    return m.target_system == 0 || m.target_system == ourselves_.system;
  }
  return false;
}

bool server::is_busy_for(sender station) const {
  if (!partner() || partner() == station)
    return false;
  return is_receiving() || vehicle_.when_read != while_read::nobody_waits;
}

} // namespace godwit::ground_port::mission_server
