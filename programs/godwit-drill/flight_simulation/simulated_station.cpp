#include "programs/godwit-drill/flight_simulation/simulated_station.hpp"

#include <algorithm>

#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "io/mavlink/enums.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {

namespace mavlink = io::mavlink;

void simulated_station::on_time(std::int64_t now_ns) {
  if (now_ns < next_heartbeat_ns_)
    return;
  next_heartbeat_ns_ = now_ns + heartbeat_every_ns;
  if (is_silent_)
    return;
  mavlink::heartbeat beat;
  beat.type = mavlink::number(mavlink::mav_type::gcs);
  beat.autopilot = mavlink::number(mavlink::mav_autopilot::invalid);
  send(beat);
}

void simulated_station::receive(std::span<const std::byte> bytes) {
  scanner_.feed_datagram(bytes, [this](const mavlink::frame_view& frame) {
    ++heard_[frame.id()];
    if (listener_)
      listener_(frame);
    if (frame.id() == mavlink::heartbeat::message_id && frame.from() == mavlink::sender{1, 1})
      mode_ = mavlink::decode<mavlink::heartbeat>(frame).custom_mode;
    if (frame.id() == mavlink::param_value::message_id)
      params_.insert(mavlink::decode<mavlink::param_value>(frame).param_index);
    hear_plan(frame);
    if (frame.id() == mavlink::statustext::message_id) {
      const auto text = mavlink::decode<mavlink::statustext>(frame);
      if (text.chunk_seq == 0 || texts_.empty())
        texts_.emplace_back();
      texts_.back() += flight::text_of(text);
    }
    if (frame.id() != mavlink::command_ack::message_id)
      return;
    const auto answer = mavlink::decode<mavlink::command_ack>(frame);
    if (answer.target_system == self.system)
      results_[answer.command] = answer.result;
    if (answer.command == mavlink::number(mavlink::mav_cmd::mission_start))
      start_answer_ = answer;
  });
}

void simulated_station::hear_plan(const mavlink::frame_view& frame) {
  if (frame.id() == mavlink::mission_current::message_id)
    current_ = mavlink::decode<mavlink::mission_current>(frame);
  if (frame.id() == mavlink::mission_ack::message_id)
    plan_answer_ = mavlink::decode<mavlink::mission_ack>(frame).type;
  if (frame.id() != mavlink::mission_request_int::message_id)
    return;
  const auto asked = mavlink::decode<mavlink::mission_request_int>(frame).seq;
  if (asked < upload_.size())
    send(upload_[asked]);
}

void simulated_station::start_mission(float first, float last) {
  start_answer_.reset();
  mavlink::command_long wanted;
  wanted.target_system = 1;
  wanted.target_component = 0;
  wanted.command = mavlink::number(mavlink::mav_cmd::mission_start);
  wanted.param1 = first;
  wanted.param2 = last;
  send(wanted);
}

void simulated_station::clear_mission() {
  plan_answer_.reset();
  send(mavlink::mission_clear_all{.target_system = 1, .target_component = 1});
}

void simulated_station::upload(std::vector<mavlink::mission_item_int> items) {
  plan_answer_.reset();
  upload_ = std::move(items);
  for (auto& each : upload_)
    each.target_system = each.target_component = 1;
  send(mavlink::mission_count{
      .target_system = 1, .target_component = 1, .count = static_cast<std::uint16_t>(upload_.size())});
}

bool simulated_station::was_told(const std::string& words) const {
  return std::ranges::any_of(texts_, [&](const std::string& each) { return each.find(words) != std::string::npos; });
}

void simulated_station::command(mavlink::mav_cmd what, float param1, float param2, float param3, float param7) {
  results_.erase(mavlink::number(what));
  send(autopilot_command(what, param1, param2, param3, param7));
}

void simulated_station::ask_for_params() {
  params_.clear();
  send(mavlink::param_request_list{.target_system = 1, .target_component = 1});
}

std::optional<std::uint8_t> simulated_station::result_of(mavlink::mav_cmd what) const {
  const auto found = results_.find(mavlink::number(what));
  return found == results_.end() ? std::nullopt : std::optional(found->second);
}

} // namespace godwit::drill
