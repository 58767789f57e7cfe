// Time from outside: actors and the runtime read it only here, so that tests can let it pass as they like.
// Thread: any.
#pragma once

#include <chrono>
#include <cstdint>

namespace godwit::runtime {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

class time_source {
public:
  time_source() = default;
  time_source(const time_source&) = delete;
  time_source& operator=(const time_source&) = delete;
  virtual ~time_source() = default;

  [[nodiscard]] virtual std::int64_t
  monotonic_ns() const noexcept = 0;                               // never goes back; no meaning outside the process
  [[nodiscard]] virtual std::int64_t wall_ns() const noexcept = 0; // since 1970 UTC; may jump
};

class system_time final : public time_source {
public:
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override {
    return std::chrono::steady_clock::now().time_since_epoch().count();
  }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override {
    return std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  }
};

} // namespace godwit::runtime
