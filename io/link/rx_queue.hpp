// What came in from the link and waits for the actor: between the link's I/O thread and the actor's.
//
// It stands outside of the mailbox, so that a flood of bytes neither grows it nor keeps commands waiting, and so that
// what came in while the actor was being restarted is not older than the bound. When it is full the newest is dropped
// and counted: what waits is answered in order, and the sender repeats what matters. Of the state of the link only the
// newest counts. Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "io/link/link.hpp"

namespace godwit::io::link {

// Ten seconds of a PX4 at its fastest streams (25 kB/s).
inline constexpr std::size_t max_waiting_bytes = 256 * 1024;

struct arrival {
  peer_id peer = 0;
  bool is_datagram = false;
  std::vector<std::byte> bytes;
};

class rx_queue {
public:
  // True: the actor sleeps and has to be woken.
  [[nodiscard]] bool put(peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    if (bytes.empty()) // a datagram can be; it says nothing, and must not take room
      return false;
    const std::lock_guard guard(mutex_);
    if (waiting_bytes_ + bytes.size() > max_waiting_bytes) {
      dropped_bytes_ += bytes.size();
      return false; // there is something in the queue, so it has been woken
    }
    waiting_bytes_ += bytes.size();
    chunks_.push_back({peer, is_datagram, {bytes.begin(), bytes.end()}});
    return !std::exchange(awake_, true);
  }

  [[nodiscard]] bool put(link_status status) {
    const std::lock_guard guard(mutex_);
    newest_status_ = status;
    status_ = std::move(status);
    return !std::exchange(awake_, true);
  }

  // Also when it was taken: what an incarnation that was just born has to know. Nothing: there was none yet.
  [[nodiscard]] std::optional<link_status> newest_status() const {
    const std::lock_guard guard(mutex_);
    return newest_status_;
  }

  // A change of the state before the oldest bytes. Nothing: all is taken, and the next put() says to wake the actor.
  [[nodiscard]] std::optional<std::variant<link_status, arrival>> take() {
    const std::lock_guard guard(mutex_);
    if (status_)
      return *std::exchange(status_, std::nullopt);
    if (chunks_.empty()) {
      awake_ = false;
      return std::nullopt;
    }
    auto result = std::move(chunks_.front());
    chunks_.pop_front();
    waiting_bytes_ -= result.bytes.size();
    return result;
  }

  [[nodiscard]] std::uint64_t dropped_bytes() const {
    const std::lock_guard guard(mutex_);
    return dropped_bytes_;
  }

private:
  mutable std::mutex mutex_;
  std::deque<arrival> chunks_;
  std::size_t waiting_bytes_ = 0;
  std::optional<link_status> status_; // not taken yet
  std::optional<link_status> newest_status_;
  std::uint64_t dropped_bytes_ = 0;
  bool awake_ = false;
};

} // namespace godwit::io::link
