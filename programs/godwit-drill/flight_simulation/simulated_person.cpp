#include "programs/godwit-drill/flight_simulation/simulated_person.hpp"

#include <cmath>
#include <utility>

#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;

namespace {

constexpr std::uint8_t autopilot_system = 1;
constexpr std::uint8_t autopilot_component = 1;

struct form_of_mode {
  bool is_command = false;
  std::uint8_t base_mode = 1; // bits of MAV_MODE_FLAG
};

form_of_mode form_of(mode_form how) {
  switch (how) {
  case mode_form::set_mode:
    return {false, 1};
  case mode_form::set_mode_disarmed:
    return {false, 29};
  case mode_form::set_mode_armed:
    return {false, 157};
  case mode_form::set_mode_armed_by_hand:
    return {false, 209};
  case mode_form::do_set_mode:
    return {true, 1};
  case mode_form::do_set_mode_armed:
    return {true, 129};
  case mode_form::do_set_mode_armed_by_hand:
    return {true, 209};
  }
  return {};
}

std::int32_t e7(double degrees) { return static_cast<std::int32_t>(std::lround(degrees * 1e7)); }

} // namespace

// -- what they do -----------------------------------------------------------------------------------

void simulated_person::send_heartbeat() {
  send(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::gcs),
                          .autopilot = mavlink::number(mavlink::mav_autopilot::invalid)});
}

void simulated_person::change_mode(sim::personality who, std::uint32_t custom_mode, mode_form how) {
  const auto form = form_of(how);
  if (!form.is_command) {
    results_.erase(mavlink::number(mav_cmd::do_set_mode));
    send(mavlink::set_mode{.target_system = autopilot_system, .base_mode = form.base_mode, .custom_mode = custom_mode});
    return;
  }
  const bool is_px4 = who == sim::personality::px4; // whose modes are in two parts
  const auto main_mode = is_px4 ? custom_mode >> 16U & 0xFFU : custom_mode;
  const auto sub_mode = is_px4 ? custom_mode >> 24U & 0xFFU : 0U;
  command(mav_cmd::do_set_mode, form.base_mode, static_cast<float>(main_mode), static_cast<float>(sub_mode));
}

void simulated_person::arm() { command(mav_cmd::component_arm_disarm, 1); }

void simulated_person::disarm(bool is_forced) {
  constexpr float forced_by = 21'196;
  command(mav_cmd::component_arm_disarm, 0, is_forced ? forced_by : 0);
}

void simulated_person::upload(plan items) {
  upload_ = std::move(items);
  plan_answer_.reset();
  send(mavlink::mission_count{.target_system = autopilot_system,
                              .target_component = autopilot_component,
                              .count = static_cast<std::uint16_t>(upload_.size())});
}

void simulated_person::choose_item(std::uint16_t sequence, bool by_message) {
  if (by_message)
    send(mavlink::mission_set_current{
        .target_system = autopilot_system, .target_component = autopilot_component, .seq = sequence});
  else
    command(mav_cmd::do_set_mission_current, sequence);
}

void simulated_person::set_home(const sim::position& where) {
  results_.erase(mavlink::number(mav_cmd::do_set_home));
  mavlink::command_int wanted;
  wanted.target_system = autopilot_system;
  wanted.target_component = autopilot_component;
  wanted.frame = mavlink::number(mavlink::mav_frame::global);
  wanted.command = mavlink::number(mav_cmd::do_set_home);
  wanted.x = e7(where.latitude_deg);
  wanted.y = e7(where.longitude_deg);
  wanted.z = static_cast<float>(where.altitude_m);
  send(wanted);
}

void simulated_person::command(mav_cmd what, float param1, float param2, float param3, float param7) {
  results_.erase(mavlink::number(what));
  send(autopilot_command(what, param1, param2, param3, param7));
}

// -- what the vehicle answers -----------------------------------------------------------------------

void simulated_person::receive(std::span<const std::byte> bytes) {
  const mavlink::frame_view frame(bytes.data());
  switch (frame.id()) {
  case mavlink::mission_request::message_id:
  case mavlink::mission_request_int::message_id:
  case mavlink::mission_ack::message_id:
  case mavlink::command_ack::message_id:
    inbox_.emplace_back(bytes.begin(), bytes.end());
    break;
  default: // they look at nothing else
    break;
  }
}

bool simulated_person::answer() {
  const auto heard = std::exchange(inbox_, {});
  for (const auto& each : heard)
    hear(mavlink::frame_view(each.data()));
  return !heard.empty();
}

void simulated_person::hear(const mavlink::frame_view& frame) {
  const auto is_for_us = [this](const auto& m) {
    return m.target_system == self_.system && m.target_component == self_.component;
  };
  if (frame.id() == mavlink::mission_request_int::message_id) {
    if (const auto m = mavlink::decode<mavlink::mission_request_int>(frame); is_for_us(m))
      give(m.seq);
  } else if (frame.id() == mavlink::mission_request::message_id) {
    if (const auto m = mavlink::decode<mavlink::mission_request>(frame); is_for_us(m))
      give(m.seq);
  } else if (frame.id() == mavlink::mission_ack::message_id) {
    if (const auto m = mavlink::decode<mavlink::mission_ack>(frame); is_for_us(m)) {
      plan_answer_ = m.type;
      has_brought_plan_ = m.type == mavlink::number(mavlink::mav_mission_result::accepted) && !upload_.empty();
    }
  } else if (frame.id() == mavlink::command_ack::message_id) {
    if (const auto m = mavlink::decode<mavlink::command_ack>(frame); is_for_us(m))
      results_[m.command] = m.result;
  }
}

void simulated_person::give(std::uint16_t sequence) {
  if (sequence >= upload_.size())
    return;
  auto item = upload_[sequence];
  item.target_system = autopilot_system;
  item.target_component = autopilot_component;
  item.seq = sequence;
  send(item);
}

std::optional<std::uint8_t> simulated_person::result_of(mav_cmd what) const {
  const auto found = results_.find(mavlink::number(what));
  return found == results_.end() ? std::nullopt : std::optional(found->second);
}

} // namespace godwit::drill
