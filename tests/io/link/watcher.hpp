// Writes down what a link tells, and lets a test wait for it. Thread: any.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "io/link/link.hpp"

namespace godwit::io::link::testing {

// Wide, because the machine may be busy: a test that passes never waits for it.
inline constexpr std::chrono::seconds patience{30};

[[nodiscard]] std::span<const std::byte> bytes_of(std::string_view text);

class watcher {
public:
  struct chunk {
    peer_id from;
    std::string bytes;
    bool is_datagram;
  };

  [[nodiscard]] link_callbacks callbacks();

  // False when the patience is over.
  [[nodiscard]] bool wait_for(const std::function<bool(const watcher&)>& what);
  [[nodiscard]] bool wait_for_phase(link_phase phase);
  [[nodiscard]] bool wait_for_reason(std::string_view part);
  // All bytes of all peers together, for streams.
  [[nodiscard]] bool wait_for_bytes(std::string_view all);
  [[nodiscard]] bool wait_for_chunks(std::size_t number);

  // Inside wait_for only; elsewhere take copies.
  std::vector<link_status> statuses;
  std::vector<chunk> chunks;
  std::vector<peer_id> left;

  [[nodiscard]] link_status last_status();
  [[nodiscard]] chunk last_chunk();
  [[nodiscard]] std::vector<link_status> all_statuses();

private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

// Polls what has no event, as counters: false when the patience is over.
[[nodiscard]] bool eventually(const std::function<bool()>& what);

// Opens a link that must open. TEXT is its URI.
[[nodiscard]] std::unique_ptr<link> open(std::string_view text, watcher& heard, const link_options& options = {});

// The port in "udpin://127.0.0.1:14550".
[[nodiscard]] std::uint16_t port_of(const link& listener);

} // namespace godwit::io::link::testing
