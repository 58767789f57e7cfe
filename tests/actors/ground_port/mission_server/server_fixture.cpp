#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>

namespace godwit::ground_port::mission_server::test {

using mavlink::number;

namespace {

std::string says(const mavlink::mission_request& m) { return "REQUEST " + std::to_string(m.seq); }
std::string says(const mavlink::mission_request_int& m) { return "REQUEST_INT " + std::to_string(m.seq); }
std::string says(const mavlink::mission_count& m) { return "COUNT " + std::to_string(m.count); }
std::string says(const mavlink::mission_item_int& m) { return "ITEM_INT " + std::to_string(m.seq); }
std::string says(const mavlink::mission_item& m) { return "ITEM " + std::to_string(m.seq); }
std::string says(const mavlink::mission_ack& m) {
  return "ACK " + std::string(io::name_of(static_cast<mavlink::mav_mission_result>(m.type)));
}

std::uint16_t command_of(int type) {
  switch (type) {
  case 1:
    return number(mavlink::mav_cmd::nav_fence_circle_inclusion);
  case 2:
    return number(mavlink::mav_cmd::nav_rally_point);
  default:
    return number(mavlink::mav_cmd::nav_waypoint);
  }
}

} // namespace

std::vector<plan_change> resolved(const std::vector<plan_change>& changes) {
  std::vector<plan_change> result;
  std::copy_if(changes.begin(), changes.end(), std::back_inserter(result),
               [](const plan_change& each) { return each.kind != plan_change_kind::begun_replacing; });
  return result;
}

mavlink::sender target_of(const outgoing& message) {
  return std::visit([](const auto& m) { return mavlink::sender{m.target_system, m.target_component}; }, message);
}

std::string in_words(const outgoing& message) {
  const auto to = target_of(message);
  const auto type = std::visit([](const auto& m) { return m.mission_type; }, message);
  auto result = std::visit([](const auto& m) { return says(m); }, message);
  if (to != station)
    result = std::to_string(to.system) + "/" + std::to_string(to.component) + " " + result;
  if (type != 0)
    result += " type " + std::to_string(type);
  return result;
}

mavlink::mission_count count_of(int count, int type) {
  mavlink::mission_count message;
  message.count = static_cast<std::uint16_t>(count);
  message.mission_type = static_cast<std::uint8_t>(type);
  return message;
}

mavlink::mission_item_int waypoint(int seq, int type) {
  mavlink::mission_item_int message;
  message.seq = static_cast<std::uint16_t>(seq);
  message.command = command_of(type);
  message.frame = number(mavlink::mav_frame::global_relative_alt);
  message.autocontinue = 1;
  message.param1 = type == 1 ? 50 : 0; // the radius of a circle
  message.x = 500'000'000 + seq;
  message.y = 364'000'000;
  message.z = 30;
  message.mission_type = static_cast<std::uint8_t>(type);
  return message;
}

mavlink::mission_ack ack_of(mavlink::mav_mission_result result, int type) {
  mavlink::mission_ack message;
  message.mission_type = static_cast<std::uint8_t>(type);
  message.type = number(result);
  return message;
}

mavlink::mission_clear_all clear_of(int type) {
  mavlink::mission_clear_all message;
  message.mission_type = static_cast<std::uint8_t>(type);
  return message;
}

mavlink::mission_request_list list_of(int type) {
  mavlink::mission_request_list message;
  message.mission_type = static_cast<std::uint8_t>(type);
  return message;
}

dialogue::words dialogue::wait(std::int64_t duration_ns) {
  const auto until_ns = now_ns_ + duration_ns;
  while (server_.next_deadline_ns() <= until_ns) {
    now_ns_ = server_.next_deadline_ns();
    hear(server_.on_time(now_ns_));
  }
  now_ns_ = until_ns;
  words result;
  for (; told_ < said_.size(); ++told_)
    result.push_back(in_words(said_[told_]));
  return result;
}

dialogue::words dialogue::upload(int count, int type, mavlink::sender from) {
  auto answer = tell(count_of(count, type), from);
  for (int i = 0; i < count; ++i)
    answer = tell(waypoint(i, type), from);
  return answer;
}

dialogue::words dialogue::texts() { return std::exchange(texts_, {}); }

const held_plan& dialogue::held(int type) const { return server_.plan(static_cast<mavlink::mav_mission_type>(type)); }

void dialogue::hear(const reaction& what) {
  said_.insert(said_.end(), what.messages.begin(), what.messages.end());
  changes_.insert(changes_.end(), what.changes.begin(), what.changes.end());
  for (const auto& each : what.texts)
    texts_.push_back(each.text);
}

} // namespace godwit::ground_port::mission_server::test
