// What godwitd has logged of late, for who opens the page later: GET /api/v1/log.
//
//   log ──publish──> hub ──text──> add: the newest max_lines ──> {"lines": [...]}, the oldest first, as the stream has
//   them
//
// Thread: add by any; the route in that of the port.
#pragma once

#include <deque>
#include <memory>
#include <mutex>

#include "actors/telemetry_stream/hub.hpp"
#include "programs/godwitd/operator_port/route.hpp"

namespace godwit::operator_port {

class log_api : public std::enable_shared_from_this<log_api> {
public:
  static constexpr std::size_t max_lines = 500; // the oldest goes

  // LINE: as it was published.
  void add(telemetry_stream::text_ptr line);
  [[nodiscard]] route_list routes();

private:
  std::mutex mutex_; // over all that follows
  std::deque<telemetry_stream::text_ptr> lines_;
};

} // namespace godwit::operator_port
