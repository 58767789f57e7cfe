// An autopilot of a few lines at the other end of a real link, for tests and benches that need a peer and no world: it
// beats, acknowledges every command, and keeps plans as the autopilot does whose habits it is given. Thread: its own
// two, the link's and the one that beats.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "actors/ground_port/mission_server/server.hpp"
#include "io/link/link.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::support {

struct loopback_vehicle_options {
  io::mavlink::mav_autopilot autopilot = io::mavlink::mav_autopilot::px4;
  ground_port::mission_server::server_profile server_profile = ground_port::mission_server::px4_profile();
  std::chrono::milliseconds beat_period{1'000};
};

class loopback_vehicle {
public:
  static constexpr io::mavlink::sender address{1, 1};

  explicit loopback_vehicle(const std::string& uri, const loopback_vehicle_options& options = {})
      : options_(options), missions_(options.server_profile, address) {
    io::link::link_callbacks callbacks;
    callbacks.received = [this](io::link::peer_id, std::span<const std::byte> bytes, bool) { hear(bytes); };
    link_ = *io::link::open_link(*io::link::parse_uri(uri), std::move(callbacks));
    beating_ = std::thread([this] { run(); });
  }
  loopback_vehicle(const loopback_vehicle&) = delete;
  loopback_vehicle& operator=(const loopback_vehicle&) = delete;
  ~loopback_vehicle() {
    {
      const std::lock_guard guard(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    beating_.join();
    link_.reset();
  }

  [[nodiscard]] std::string description() const { return link_->description(); }
  [[nodiscard]] std::uint64_t heartbeats_heard() const { return heartbeats_.load(); }
  [[nodiscard]] std::uint64_t commands_heard() const { return commands_.load(); }
  [[nodiscard]] std::vector<io::mavlink::mission_item_int> plan(io::mavlink::mav_mission_type type) const {
    const std::lock_guard guard(mutex_);
    return missions_.plan(type).items;
  }

private:
  [[nodiscard]] static std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

  void hear(std::span<const std::byte> bytes) {
    {
      const std::lock_guard guard(mutex_);
      scanner_.feed(bytes, [this](const io::mavlink::frame_view& frame) {
        io::mavlink::visit(frame, [&](const auto& message) { hear(frame.from(), message); });
      });
    }
    changed_.notify_all(); // there may be a nearer deadline
  }

  template <class M>
  void hear(io::mavlink::sender from, const M& message) {
    using namespace io::mavlink;
    if constexpr (std::is_same_v<M, heartbeat>)
      ++heartbeats_;
    if constexpr (std::is_same_v<M, command_long>) {
      ++commands_;
      say(command_ack{.command = message.command, .target_system = from.system, .target_component = from.component});
    }
    if constexpr (std::is_constructible_v<ground_port::mission_server::incoming, const M&>)
      say(missions_.on(from, message, now_ns()));
  }

  void say(const ground_port::mission_server::reaction& what) {
    for (const auto& each : what.messages)
      std::visit([this](const auto& message) { say(message); }, each);
  }

  template <io::mavlink::message M>
  void say(const M& message) {
    if (link_)
      link_->send(encode(message, address, sequence_++).span());
  }

  void run() {
    auto next_beat = std::chrono::steady_clock::now();
    std::unique_lock guard(mutex_);
    while (!ending_) {
      if (std::chrono::steady_clock::now() >= next_beat) {
        say(io::mavlink::heartbeat{.type = io::mavlink::number(io::mavlink::mav_type::quadrotor),
                                   .autopilot = io::mavlink::number(options_.autopilot)});
        next_beat += options_.beat_period;
      }
      say(missions_.on_time(now_ns()));
      const auto left_ns = missions_.next_deadline_ns() - now_ns();
      const auto until =
          std::min(next_beat, std::chrono::steady_clock::now() +
                                  std::chrono::nanoseconds(std::clamp<std::int64_t>(left_ns, 0, 1'000'000'000)));
      changed_.wait_until(guard, until);
    }
  }

  const loopback_vehicle_options options_;
  std::atomic<std::uint64_t> heartbeats_{0};
  std::atomic<std::uint64_t> commands_{0};
  mutable std::mutex mutex_; // guards all below
  std::condition_variable changed_;
  bool ending_ = false;
  std::uint8_t sequence_ = 0;
  io::mavlink::scanner scanner_;
  ground_port::mission_server::server missions_;
  std::unique_ptr<io::link::link> link_;
  std::thread beating_;
};

} // namespace godwit::support
