// A ground station of a few lines, for tests: speaks MAVLink over a link and writes down what it hears. Thread: any.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/link/link.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums/command.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/scanner.hpp"
#include "tests/io/link/watcher.hpp"

namespace godwit::sim {

class station {
public:
  static constexpr io::mavlink::sender identity{255, 190};

  explicit station(const std::string& uri) {
    auto opened =
        io::link::open_link(io::link::parse_uri(uri).value(),
                            {[this](io::link::peer_id, std::span<const std::byte> bytes, bool) { received(bytes); },
                             [this](const io::link::link_status& status) { changed(status); }});
    if (!opened)
      throw std::runtime_error(opened.error());
    link_ = *std::move(opened);
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, io::link::testing::patience, [this] { return is_up_; }))
      throw std::runtime_error(uri + " does not come up");
  }

  template <io::mavlink::message M>
  void send(const M& message) {
    static_cast<void>(link_->send(io::mavlink::encode(message, identity, sequence_++).span()));
  }
  void send_bytes(std::span<const std::byte> bytes) { static_cast<void>(link_->send(bytes)); }

  // Waits with patience until a message that fits is heard, sending a heartbeat of its own now and then: a vehicle that
  // listens knows nobody before. What was heard before counts, and is used up up to it.
  template <io::mavlink::message M>
  [[nodiscard]] std::optional<M> wait_for(const std::function<bool(const M&)>& fits = {}) {
    const auto end = std::chrono::steady_clock::now() + io::link::testing::patience;
    std::unique_lock lock(mutex_);
    while (std::chrono::steady_clock::now() < end) {
      for (auto& waiting = heard_[M::message_id]; !waiting.empty();) {
        const auto bytes = std::move(waiting.front());
        waiting.pop_front();
        if (const auto message = io::mavlink::decode<M>(io::mavlink::frame_view(bytes.data())); !fits || fits(message))
          return message;
      }
      lock.unlock();
      send(io::mavlink::heartbeat{.type = 6, .autopilot = 8});
      lock.lock();
      changed_.wait_for(lock, std::chrono::milliseconds(100));
    }
    return std::nullopt;
  }
  // The result of COMMAND.
  [[nodiscard]] std::optional<int> command(io::mavlink::command_long command) {
    send(command);
    const auto ack = wait_for<io::mavlink::command_ack>(
        [&](const io::mavlink::command_ack& each) { return each.command == command.command; });
    return ack ? std::optional<int>(static_cast<int>(ack->result)) : std::nullopt;
  }
  // And it was not waited for.
  template <io::mavlink::message M>
  [[nodiscard]] bool has_heard() {
    const std::lock_guard lock(mutex_);
    return !heard_[M::message_id].empty();
  }
  [[nodiscard]] std::uint64_t frames() {
    const std::lock_guard lock(mutex_);
    return frames_;
  }
  [[nodiscard]] std::optional<std::uint8_t> system() {
    const std::lock_guard lock(mutex_);
    return system_;
  }
  [[nodiscard]] io::link::link& line() { return *link_; }

private:
  static constexpr std::size_t max_kept = 1'000; // of each message

  void changed(const io::link::link_status& status) {
    const std::lock_guard lock(mutex_);
    is_up_ = status.phase == io::link::link_phase::up;
    changed_.notify_all();
  }

  void received(std::span<const std::byte> bytes) {
    const std::lock_guard lock(mutex_);
    scanner_.feed(bytes, [this](const io::mavlink::frame_view& frame) {
      ++frames_;
      system_ = frame.system();
      auto& kept = heard_[frame.id()];
      if (kept.size() < max_kept)
        kept.emplace_back(frame.bytes().begin(), frame.bytes().end());
    });
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  io::mavlink::scanner scanner_;
  std::map<std::uint32_t, std::deque<std::vector<std::byte>>> heard_;
  std::uint64_t frames_ = 0;
  bool is_up_ = false;
  std::optional<std::uint8_t> system_;
  std::uint8_t sequence_ = 0;
  std::unique_ptr<io::link::link> link_;
};

} // namespace godwit::sim
