#include "programs/godwitd/durations.hpp"

#include <algorithm>

namespace godwit::daemon {

std::string duration_text(std::int64_t duration_ns) {
  const auto tenths = std::max<std::int64_t>(duration_ns, 0) / 100'000'000;
  const auto seconds = tenths / 10;
  const auto minutes = seconds / 60;
  const auto hours = minutes / 60;
  if (tenths > 0 && seconds < 10)
    return std::to_string(seconds) + "." + std::to_string(tenths % 10) + " s";
  if (minutes < 2)
    return std::to_string(seconds) + " s";
  if (hours < 1)
    return std::to_string(minutes) + " min";
  if (hours < 48)
    return std::to_string(hours) + " h" + (minutes % 60 == 0 ? "" : " " + std::to_string(minutes % 60) + " min");
  return std::to_string(hours / 24) + " days";
}

} // namespace godwit::daemon
