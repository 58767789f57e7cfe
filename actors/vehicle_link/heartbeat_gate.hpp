// Whether our heartbeat may go out: only while the actors that decide in this process live.
//
// An autopilot that hears our heartbeat believes that somebody is in charge here. The thread that sends it goes on
// while the executor hangs; so the guardian, whose pings both executor and failsafe answer, tells vehicle_link that
// they do (runtime::child_alive). Pure: time comes in as monotonic nanoseconds.
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
      deciders_.push_back({each, std::nullopt});
  }

  void on_alive(const std::string& name, std::int64_t now_ns) {
    for (auto& each : deciders_)
      if (each.name == name)
        each.last_ns = now_ns;
  }

  // Who keeps the gate shut; nobody: it is open.
  [[nodiscard]] std::optional<std::string> missing(std::int64_t now_ns) const {
    for (const auto& each : deciders_)
      if (!each.last_ns || now_ns - *each.last_ns > lasts_ns_)
        return each.name;
    return std::nullopt;
  }

private:
  struct decider {
    std::string name;
    std::optional<std::int64_t> last_ns; // none: not heard of yet
  };
  std::int64_t lasts_ns_;
  std::vector<decider> deciders_;
};

} // namespace godwit::vehicle_link
