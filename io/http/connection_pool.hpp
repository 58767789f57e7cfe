// Connections to the service that wait for their next request. The one used last comes first: the others may age out.
//
// Thread: the client's.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>

#include "io/http/connection.hpp"

namespace godwit::io::http {

class connection_pool {
public:
  connection_pool(std::size_t max_kept, std::chrono::milliseconds keep_for, std::atomic<std::uint64_t>& gauge)
      : max_kept_(max_kept), keep_for_(keep_for), gauge_(gauge) {}

  // Null: none that is young enough and quiet. That it looks alive does not say that it is.
  [[nodiscard]] std::unique_ptr<connection> take(std::chrono::steady_clock::time_point now);
  void put(std::unique_ptr<connection> unused, std::chrono::steady_clock::time_point now);

private:
  std::size_t max_kept_;
  std::chrono::milliseconds keep_for_;
  std::atomic<std::uint64_t>& gauge_;
  std::deque<std::unique_ptr<connection>> idle_; // the oldest in front
};

} // namespace godwit::io::http
