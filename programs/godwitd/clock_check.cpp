#include "programs/godwitd/clock_check.hpp"

#include <ctime>
#include <limits>

#include "io/time_units.hpp"

namespace godwit::daemon {
namespace {

constexpr std::int64_t century_s = 3'155'760'000;
constexpr std::int64_t last_s = std::numeric_limits<std::int64_t>::max() / ns_per_s - century_s;

std::int64_t seconds_of(clockid_t which) {
  timespec now{};
  ::clock_gettime(which, &now);
  return now.tv_sec;
}

} // namespace

clock_reading clock_now() { return {seconds_of(CLOCK_REALTIME), seconds_of(CLOCK_MONOTONIC)}; }

std::optional<std::string> objection_to_clock(const clock_reading& now) {
  if (now.wall_s < last_s && now.wall_s >= -last_s && now.monotonic_s < last_s)
    return std::nullopt;
  return "the clock of this computer is " + std::to_string(now.wall_s) +
         " s from 1970, centuries from now; set it (timedatectl set-time) and start godwitd again";
}

} // namespace godwit::daemon
