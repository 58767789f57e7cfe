// Plans that go out. See server.hpp.
#include "actors/ground_port/mission_server/item_forms.hpp"
#include "actors/ground_port/mission_server/server.hpp"

namespace godwit::ground_port::mission_server {

using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using mavlink::sender;

void server::take(sender from, const mavlink::mission_request_list& m, std::int64_t now_ns) {
  const auto* download = std::get_if<giving>(&session_);
  const bool is_full =
      download != nullptr && static_cast<std::size_t>(download->next) == store_.plan(download->type).items.size();
  if (is_full && vehicle_.list_ends_a_full_download)
    end_session();
  if (is_busy_for(from) || is_receiving()) {
    refuse_as_busy(from, m.mission_type, vehicle_.when_list_is_refused, occasion::list_while_busy);
  } else if (!is_one_type(m.mission_type)) {
    acknowledge(from, m.mission_type, mav_mission_result::unsupported);
  } else {
    const auto type = static_cast<mav_mission_type>(m.mission_type);
    session_ = giving{from, type, 0, now_ns};
    send_count(from, type);
  }
}

void server::take(sender from, const mavlink::mission_request_int& m, std::int64_t now_ns) {
  if (vehicle_.serves_any_item && is_receiving())
    refuse_as_busy(from, m.mission_type, vehicle_.when_list_is_refused, occasion::list_while_busy);
  else if (const auto item = item_for(from, m.mission_type, m.seq, now_ns))
    send(from, *item);
}

void server::take(sender from, const mavlink::mission_request& m, std::int64_t now_ns) {
  if (!vehicle_.serves_float_items) {
    acknowledge(from, m.mission_type, mav_mission_result::unsupported);
  } else if (const auto item = item_for(from, m.mission_type, m.seq, now_ns)) {
    send(from, in_floats(*item));
    say(occasion::float_request, {.type = m.mission_type, .who = from});
  }
}

// Nothing: it is not there, or not its turn; where the vehicle says so, that has been sent.
std::optional<mavlink::mission_item_int> server::item_for(sender to, std::uint8_t type, int seq, std::int64_t now_ns) {
  auto* download = std::get_if<giving>(&session_);
  const bool is_theirs = download != nullptr && download->to == to && number(download->type) == type;
  if (!is_one_type(type) || (!is_theirs && !vehicle_.serves_any_item))
    return std::nullopt;
  const auto& items = store_.plan(static_cast<mav_mission_type>(type)).items;
  if (static_cast<std::size_t>(seq) >= items.size()) {
    if (vehicle_.tells_count_to_the_lost)
      send_count(to, static_cast<mav_mission_type>(type));
    if (vehicle_.serves_any_item)
      acknowledge(to, type, mav_mission_result::invalid_sequence);
    return std::nullopt;
  }
  if (is_theirs) {
    const auto earliest = vehicle_.serves_earlier_items ? 0 : download->next - 1;
    const bool is_its_turn = earliest <= seq && seq <= download->next;
    if (!is_its_turn && !vehicle_.serves_any_item)
      return std::nullopt;
    download->next = vehicle_.serves_earlier_items ? std::max(download->next, seq + 1) : seq + 1;
    download->heard_ns = now_ns;
  }
  auto item = items[static_cast<std::size_t>(seq)];
  item.seq = static_cast<std::uint16_t>(seq);
  item.mission_type = type;
  if (vehicle_.marks_current && type == number(mav_mission_type::mission))
    item.current = seq == current_ ? 1 : 0;
  return item;
}

void server::send_count(sender to, mav_mission_type type) {
  const auto& plan = store_.plan(type);
  mavlink::mission_count answer;
  answer.mission_type = number(type);
  answer.count = static_cast<std::uint16_t>(plan.items.size());
  answer.opaque_id = plan.id;
  send(to, answer);
}

} // namespace godwit::ground_port::mission_server
