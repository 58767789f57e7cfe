// A ground station clears the mission: what godwit holds first, and then what the vehicle holds.
//
//   refused (why_never): nothing changes
//   something else is under way: it waits for that, waits_ns at most, and is refused then
//   else: the plan is dropped ──on the disk──> sent to the vehicle ──outcome──> taken, or failed
//
// A crash in between leaves a vehicle that may hold a plan and a godwit that starts none; the station has no answer
// then and says it again. Only a vehicle that stands disarmed and that godwit has is cleared, looked at once more when
// the disk has written, and by the link as it sends. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/phase_table.hpp"

namespace godwit::executor {

// Numbers of its own, above those of the runner and of what is read back.
inline constexpr std::uint64_t first_clearing = 1ULL << 33U;

class plan_clearing {
public:
  plan_clearing(flight_context& flight, phase_machine& phases) : flight_(flight), phases_(phases) {}

  // HAS_LOOKED: this incarnation knows how the vehicle stands. Answered with plan_judged to the port; what is asked
  // again meanwhile is answered with the same outcome.
  void begin(effects& out, bool has_looked, instant now);
  // One that waits is begun, or refused, here.
  void look(effects& out, bool has_looked, instant now);
  [[nodiscard]] bool is_waiting() const { return waits_until_ns_ != 0; }
  [[nodiscard]] bool awaits(std::uint64_t number) const { return is_under_way_ && number == last_number_; }
  [[nodiscard]] bool is_under_way() const { return is_under_way_; }
  // The vehicle is still one that may be cleared.
  [[nodiscard]] bool may_go_out() const { return why_not_vehicle().empty(); }
  void on_transfer(effects& out, std::uint64_t number, const vehicle_link::transfer::outcome& outcome);

private:
  // Shorter than ground_port waits for what becomes of it.
  static constexpr std::int64_t waits_ns = 3'500'000'000;

  [[nodiscard]] std::string why_never() const;
  [[nodiscard]] bool is_busy(bool has_looked) const;
  [[nodiscard]] std::string why_not_vehicle() const;
  void refuse(effects& out, const std::string& why);
  void clear(effects& out, instant now);
  void drop_plan(effects& out);

  flight_context& flight_;
  phase_machine& phases_;
  bool is_under_way_ = false;
  std::int64_t waits_until_ns_ = 0; // monotonic; 0: none waits
  std::uint64_t last_number_ = first_clearing;
};

} // namespace godwit::executor
