// What a simulated vehicle is made of, and the order in which its parts get their turns.
//
//   frames ──> address check ──> autopilot, plans, params ──> outlet ──> frames
//   time   ──> body and battery ──> autopilot ──> plans, params, streams ──> outlet
//
// Each event first brings the world up to now, so that what comes in meets the vehicle as it is then. The next deadline
// is worked out once after each event. Thread: one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "actors/ground_port/mission_server/server.hpp"
#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"
#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"
#include "programs/godwit-sim/vehicle/autopilot/file_server.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::sim {

class vehicle::parts {
public:
  parts(const vehicle_settings& settings, std::int64_t now_ns, frame_sink send);

  line_number add_line(frame_sink send, std::int64_t now_ns);
  void on_frame(const mavlink::frame_view& frame, std::int64_t now_ns, line_number line);
  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const { return deadline_ns_; }

  void reboot(std::int64_t now_ns);
  void lose_position(bool lost, std::int64_t now_ns);
  void block(bool is_blocked, std::int64_t now_ns);
  void set_battery(double percent, std::int64_t now_ns);
  void limit_distance(double metres) { pilot_->limit_distance(metres); }
  void breach_fence(std::int64_t now_ns);
  void say(std::string_view words, std::int64_t now_ns);
  void refuse_command(std::uint16_t command, std::uint8_t result, int times);

  [[nodiscard]] vehicle_picture describe() const;
  [[nodiscard]] const std::vector<mavlink::mission_item_int>& mission_items() const {
    return plans_.plan(mavlink::mav_mission_type::mission).items;
  }

  static constexpr std::int64_t start_takes_ns = 3 * ns_per_s; // in which nothing is heard of it; real time

private:
  // Brings everything up to NOW.
  void advance(std::int64_t now_ns);
  void advance_world();
  void advance_autopilot();
  void advance_plans();
  void advance_params();
  // Sends what is left to say, and finds the next deadline.
  void end_turn();
  void find_deadline();
  void start_up();

  void hear(mavlink::sender from, const mavlink::heartbeat& m);
  void hear(mavlink::sender from, const mavlink::set_mode& m);
  void hear(mavlink::sender from, const mavlink::ping& m);
  void hear(mavlink::sender from, const mavlink::timesync& m);
  void hear(mavlink::sender from, const mavlink::command_long& m);
  void hear(mavlink::sender from, const mavlink::command_int& m);
  void hear(mavlink::sender from, const mavlink::mission_set_current& m);
  void hear(mavlink::sender from, const mavlink::param_request_list& m);
  void hear(mavlink::sender from, const mavlink::param_request_read& m);
  void hear(mavlink::sender from, const mavlink::param_set& m);
  void hear(mavlink::sender from, const mavlink::request_data_stream& m);
  void hear(mavlink::sender from, const plans::incoming& m);
  void hear_file_request(mavlink::sender from, mavlink::byte_view payload);
  void hear_sticks(mavlink::byte_view payload);
  [[nodiscard]] bool flies_to(mavlink::sender from, const plans::incoming& m); // true: it has its answer

  // Orders, parameters and such, by their target.
  [[nodiscard]] bool is_for_us(std::uint8_t system, std::uint8_t component) const;
  [[nodiscard]] bool is_asked_of_all(const mavlink::command_long& m) const;
  void take_rally_points();
  void react(const plans::reaction& to, bool was_receiving);
  void note_partner(mavlink::sender who);
  [[nodiscard]] outlet::line_set lines_of_partner(mavlink::sender who) const;
  [[nodiscard]] double load() const;
  [[nodiscard]] line_streams make_streams();
  void send_streams();
  void send_aircraft();

  vehicle_settings settings_;
  const traits& traits_;
  world_clock clock_;
  instant now_;
  std::mt19937_64 random_;
  outlet out_;
  flight craft_;
  battery power_;
  condition state_;
  telemetry tells_;
  plans::server plans_;
  role::param_table params_;
  file_server files_;
  std::vector<line_streams> streams_; // by line
  std::unique_ptr<autopilot> pilot_;
  line_number params_line_ = 0;                                    // where all of them were asked for last
  std::vector<std::pair<mavlink::sender, line_number>> uploaders_; // and readers: where each was heard last
  std::int64_t next_aircraft_ns_ = 0;                              // world time
  std::int64_t silent_until_ns_ = 0;                               // real time; while it starts
  bool is_starting_ = false;
  std::int64_t deadline_ns_ = 0;
};

} // namespace godwit::sim
