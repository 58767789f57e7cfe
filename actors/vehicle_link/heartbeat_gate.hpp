// Whether our heartbeat may go out: only while all who have to liveness_report for this process did so lately.
//
// An autopilot that hears our heartbeat believes that somebody is in charge here. A thread that can not see a fault
// must not say so, and so the executor and the failsafe tell vehicle_link once a second that they are well. Pure: time
// comes in as monotonic nanoseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace godwit::vehicle_link {

class heartbeat_gate {
public:
  heartbeat_gate(const std::vector<std::string>& names, std::int64_t lasts_ms) : lasts_ns_(lasts_ms * 1'000'000) {
    for (const auto& each : names)
      liveness_reporters_.push_back({each, std::nullopt});
  }

  void on_liveness_report(const std::string& name, std::int64_t now_ns) {
    for (auto& each : liveness_reporters_)
      if (each.name == name)
        each.last_ns = now_ns;
  }

  // Who keeps the gate shut; nobody: it is open.
  [[nodiscard]] std::optional<std::string> missing(std::int64_t now_ns) const {
    for (const auto& each : liveness_reporters_)
      if (!each.last_ns || now_ns - *each.last_ns > lasts_ns_)
        return each.name;
    return std::nullopt;
  }

private:
  struct liveness_reporter {
    std::string name;
    std::optional<std::int64_t> last_ns;
  };
  std::int64_t lasts_ns_;
  std::vector<liveness_reporter> liveness_reporters_;
};

} // namespace godwit::vehicle_link
