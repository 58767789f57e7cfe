// A ground station and its operator in virtual time: heartbeats once a second; plans and commands on request. On its
// line nothing is lost, so it says nothing twice. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::drill {

class simulated_station {
public:
  static constexpr std::int64_t heartbeat_every_ns = 1'000'000'000;
  static constexpr io::mavlink::sender self{255, 190};

  using frame_sink = std::function<void(std::span<const std::byte>)>;

  explicit simulated_station(frame_sink send) : send_(std::move(send)) {}

  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const { return next_heartbeat_ns_; }
  void receive(std::span<const std::byte> bytes);
  // Of each frame, before anything comes of it.
  void listen(std::function<void(const io::mavlink::frame_view&)> listener) { listener_ = std::move(listener); }

  void start_mission(float first = 0, float last = 0);
  void clear_mission();
  // COUNT, and each item that is asked for.
  void upload(std::vector<io::mavlink::mission_item_int> items);
  // To the autopilot, as a station that knows of no godwit speaks.
  void command(io::mavlink::mav_cmd what, float param1 = 0, float param2 = 0, float param3 = 0, float param7 = 0);
  void ask_for_params();
  // As it is, whoever has made it.
  void send_frame(std::span<const std::byte> frame) { send_(frame); }
  template <class M>
  void send(const M& what) {
    send_(io::mavlink::encode(what, self, sequence_++).span());
  }
  // The result of the last answer to WHAT; none: it has not come.
  [[nodiscard]] std::optional<std::uint8_t> result_of(io::mavlink::mav_cmd what) const;
  [[nodiscard]] std::size_t params_heard() const { return params_.size(); }
  [[nodiscard]] std::size_t heard(std::uint32_t message) const {
    const auto found = heard_.find(message);
    return found == heard_.end() ? 0 : found->second;
  }
  // Heartbeats come no more, as when the operator's radio is off.
  void fall_silent() { is_silent_ = true; }

  [[nodiscard]] const std::optional<io::mavlink::command_ack>& start_answer() const { return start_answer_; }
  // MAV_MISSION_RESULT of the last upload or clear; none: it has not come.
  [[nodiscard]] std::optional<std::uint8_t> plan_answer() const { return plan_answer_; }
  [[nodiscard]] const std::optional<io::mavlink::mission_current>& current() const { return current_; }
  [[nodiscard]] bool was_told(const std::string& words) const;
  // HEARTBEAT.custom_mode of the vehicle, as it was heard last.
  [[nodiscard]] const std::optional<std::uint32_t>& mode() const { return mode_; }

private:
  frame_sink send_;
  std::function<void(const io::mavlink::frame_view&)> listener_;
  io::mavlink::scanner scanner_;
  std::uint8_t sequence_ = 0;
  std::int64_t next_heartbeat_ns_ = 0;
  bool is_silent_ = false;
  std::optional<io::mavlink::command_ack> start_answer_;
  void hear_plan(const io::mavlink::frame_view& frame);

  std::vector<io::mavlink::mission_item_int> upload_;
  std::optional<std::uint8_t> plan_answer_;
  std::optional<io::mavlink::mission_current> current_;
  std::vector<std::string> texts_;
  std::optional<std::uint32_t> mode_;
  std::map<std::uint16_t, std::uint8_t> results_; // of commands
  std::map<std::uint32_t, std::size_t> heard_;    // frames by message
  std::set<std::uint16_t> params_;                // by index
};

} // namespace godwit::drill
