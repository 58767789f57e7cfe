// Real time as the vehicles see it: nanoseconds since 1970 when the program started, and from then on as the steady
// clock goes, so that nobody's setting of the wall clock moves a vehicle. Thread: any.
#pragma once

#include <chrono>
#include <cstdint>
#include <type_traits>

namespace godwit::sim {

class host_clock {
public:
  using steady = std::chrono::steady_clock;

  [[nodiscard]] std::int64_t now_ns() const { return steady::now().time_since_epoch().count() + offset_ns_; }
  [[nodiscard]] steady::time_point at(std::int64_t ns) const {
    return steady::time_point(std::chrono::nanoseconds(ns - offset_ns_));
  }

private:
  static_assert(std::is_same_v<steady::duration, std::chrono::nanoseconds>);
  std::int64_t offset_ns_ =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count() -
      steady::now().time_since_epoch().count();
};

} // namespace godwit::sim
