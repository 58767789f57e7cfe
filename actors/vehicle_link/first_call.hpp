// Asks for a heartbeat on a line on which nobody was heard yet, so that a process that comes back in flight knows its
// vehicle within a moment and not within the second that the vehicle takes between two.
//
// The call is MAV_CMD_REQUEST_MESSAGE for HEARTBEAT to the autopilot (component 1) of the system that is meant, or of
// all systems; who does not know the command says so and is heard by that. Quick at first, then once a second, and over
// as soon as a vehicle is heard. Times: monotonic nanoseconds. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

namespace godwit::vehicle_link {

class first_call {
public:
  static constexpr int quick_calls = 8;
  static constexpr std::int64_t quick_period_ns = 250'000'000;
  static constexpr std::int64_t period_ns = 1'000'000'000;

  void begin(std::int64_t now_ns) {
    calls_ = 0;
    next_ns_ = now_ns;
  }
  void end() { next_ns_.reset(); }

  // It is time for one.
  [[nodiscard]] bool is_due(std::int64_t now_ns) const { return next_ns_ && now_ns >= *next_ns_; }
  void called(std::int64_t now_ns) {
    ++calls_;
    next_ns_ = now_ns + (calls_ < quick_calls ? quick_period_ns : period_ns);
  }
  [[nodiscard]] int calls() const { return calls_; } // since begin()
  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const { return next_ns_; }

private:
  int calls_ = 0;
  std::optional<std::int64_t> next_ns_; // nothing: nobody is called
};

} // namespace godwit::vehicle_link
