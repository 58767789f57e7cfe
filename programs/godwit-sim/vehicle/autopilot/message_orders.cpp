// Commands that ask for messages, once or at an interval.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_result;

// MESSAGE_INTERVAL (244), whose field `message_id` is in the way of a struct: interval_us i32, message_id u16.
constexpr std::uint32_t message_interval_id = 244;
constexpr std::uint8_t message_interval_crc_extra = 95;
constexpr std::size_t message_interval_size = 6;

std::optional<std::uint32_t> message_in(float param) {
  if (!std::isfinite(param) || param < 0 || param >= 0x1p24F || std::trunc(param) != param)
    return std::nullopt;
  return static_cast<std::uint32_t>(param);
}

} // namespace

mav_result autopilot::give(std::uint32_t message) {
  if (message == mavlink::mission_current::message_id && autopilot_quirks().current_is_a_request_away) {
    with_.out.send(progress());
    return mav_result::accepted;
  }
  return with_.tells.send(message, now_.world_ns) ? mav_result::accepted : autopilot_quirks().unknown_message;
}

// On the line of who asks: a PX4 before its answer, an ArduPilot after it.
mav_result autopilot::give_or_owe(std::uint32_t message) {
  if (autopilot_quirks().sends_before_ack) {
    const auto there = aim_back();
    return give(message);
  }
  owed_message_ = message;
  return mav_result::accepted;
}

mav_result autopilot::request_message(const role::order& what) {
  const auto message = message_in(what.param1);
  if (!message)
    return autopilot_quirks().unknown_message;
  const bool is_current =
      *message == mavlink::mission_current::message_id && autopilot_quirks().current_is_a_request_away;
  if (!autopilot_quirks().sends_before_ack && !is_current && !with_.tells.knows(*message))
    return autopilot_quirks().unknown_message;
  return give_or_owe(*message);
}

mav_result autopilot::set_message_interval(const role::order& what) {
  const auto message = message_in(what.param1);
  const bool is_interval =
      std::isfinite(what.param2) && std::abs(what.param2) < static_cast<float>(role::message_schedule::max_interval_us);
  const auto interval_us = is_interval ? static_cast<std::int64_t>(what.param2) : -2; // one that is none
  if (message == mavlink::mission_current::message_id && autopilot_quirks().current_is_a_request_away &&
      interval_us >= -1) {
    const auto period_ns = interval_us == 0 ? role::current_report::period_ns : interval_us * 1'000;
    streams().current.set_period(std::max<std::int64_t>(period_ns, 0), now_.world_ns);
    return mav_result::accepted;
  }
  if (message && streams().messages.set_interval(*message, interval_us, now_.world_ns))
    return mav_result::accepted;
  if (autopilot_quirks().autopilot == mavlink::mav_autopilot::ardupilotmega && message)
    say(mavlink::mav_severity::info, "No ap_message for mavlink id (" + std::to_string(*message) + ")");
  return autopilot_quirks().unknown_interval;
}

mav_result autopilot::get_message_interval(const role::order& what) {
  const auto message = message_in(what.param1);
  if (!message)
    return mav_result::denied;
  const auto interval_us = streams().messages.interval_us(*message);
  const auto id = static_cast<std::uint16_t>(*message);
  std::array<std::byte, message_interval_size> payload{};
  std::memcpy(payload.data(), &interval_us, sizeof interval_us);
  std::memcpy(payload.data() + sizeof interval_us, &id, sizeof id);
  const auto there = aim_back();
  with_.out.send_payload(message_interval_id, message_interval_crc_extra, payload);
  return mav_result::accepted;
}

mav_result autopilot::request_capabilities(const role::order&) {
  return give_or_owe(mavlink::autopilot_version::message_id);
}

mav_result autopilot::request_protocol_version(const role::order&) {
  if (!autopilot_quirks().tells_protocol_version)
    return mav_result::unsupported;
  const auto there = aim_back();
  return give(mavlink::protocol_version::message_id);
}

mav_result autopilot::get_home(const role::order&) { return give_or_owe(mavlink::home_position::message_id); }

} // namespace godwit::sim
