#include "programs/godwit-sim/host/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"

namespace godwit::sim {
namespace {

namespace mavlink = io::mavlink;

double battery_level(double percent) { return std::ceil(percent / event_watch::battery_step_percent); }

std::string item_of(const vehicle_picture& now) {
  return "item " + std::to_string(now.mission_current) + " of a plan of " + std::to_string(now.mission_count);
}

std::string plan_sentence(const vehicle_picture& now) {
  return now.mission_count == 0 ? "has no mission any more"
                                : "has a mission of " + std::to_string(now.mission_count) + " items";
}

std::string mission_sentence(const vehicle_picture& now) {
  if (now.mission_state == "running")
    return "mission running, " + item_of(now);
  return "mission " + now.mission_state;
}

} // namespace

std::vector<std::string> event_watch::look(const vehicle_picture& now) {
  std::vector<std::string> told;
  const auto tell = [&](bool is_new, std::string sentence) {
    if (has_looked_ && is_new)
      told.push_back(std::move(sentence));
  };
  tell(now.world_ms < last_.world_ms, "started again");
  tell(now.has_position != last_.has_position, now.has_position ? "has a position" : "has lost its position");
  tell(now.mission_count != last_.mission_count || now.mission_id != last_.mission_id, plan_sentence(now));
  tell(now.armed != last_.armed, now.armed ? "armed" : "disarmed");
  tell(now.mode != last_.mode, "mode " + now.mode);
  tell(now.in_air != last_.in_air, now.in_air ? "took off" : "landed");
  tell(now.mission_state != last_.mission_state, mission_sentence(now));
  tell(battery_level(now.battery_percent) < battery_level(last_.battery_percent),
       "battery " + std::to_string(std::lround(now.battery_percent)) + " %");
  if (now.mission_state == "running" && last_.mission_state != "running")
    reached_ = -1; // on the way again: the same item may be reached anew
  last_ = now;
  has_looked_ = true;
  return told;
}

std::string event_watch::sent(const mavlink::frame_view& frame) {
  if (frame.id() == mavlink::mission_item_reached::message_id) {
    const int sequence = mavlink::decode<mavlink::mission_item_reached>(frame).seq;
    if (sequence == std::exchange(reached_, sequence))
      return {};
    return "item " + std::to_string(sequence) + " reached";
  }
  if (frame.id() == mavlink::statustext::message_id) {
    const auto message = mavlink::decode<mavlink::statustext>(frame);
    const auto text = io::text_in(message.text);
    return "says: " + std::string(text.substr(0, text.find_last_not_of(" \t") + 1)); // PX4's end with a tab
  }
  return {};
}

std::string event_watch::heard(const mavlink::frame_view& frame) {
  if (frame.id() != mavlink::heartbeat::message_id)
    return {};
  const auto who = frame.from();
  if (stations_.size() == max_stations || std::find(stations_.begin(), stations_.end(), who) != stations_.end())
    return {};
  stations_.push_back(who);
  return "hears " + std::to_string(who.system) + "/" + std::to_string(who.component);
}

} // namespace godwit::sim
