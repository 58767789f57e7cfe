#include "tests/programs/godwitd/flight_simulation/simulated_station.hpp"

#include "io/mavlink/enums.hpp"

namespace godwit::tests {

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
    if (frame.id() != mavlink::command_ack::message_id)
      return;
    const auto answer = mavlink::decode<mavlink::command_ack>(frame);
    if (answer.command == mavlink::number(mavlink::mav_cmd::mission_start))
      start_answer_ = answer;
  });
}

void simulated_station::start_mission() {
  start_answer_.reset();
  mavlink::command_long wanted;
  wanted.target_system = 1;
  wanted.target_component = 0;
  wanted.command = mavlink::number(mavlink::mav_cmd::mission_start);
  send(wanted);
}

} // namespace godwit::tests
