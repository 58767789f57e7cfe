// Who has the vehicle, as far as the failsafe can tell without an executor.
//
//             ┌──a mode that nobody of ours expects, or the executor says so──┐
//             │                                                               v
//   ──> ours ─┘                                                          a pilot
//             ^                                                               │
//             └───────────────────────hand-back──────────────────────────────┘
//
// The rules of control_authority, and what of them survives a restart. The executor says which changes are ours before
// they happen, and how the plan on the vehicle ends. Without an executor this errs to the side of silence: the
// autopilot's own failsafes are still there. A take-off that was seen is ours when it was commanded, or when it is that
// of a plan; its heartbeat may be older than what shows the take-off, so that a newer one is waited for. After a
// restart the mode is compared with the last one that was ours; without such a record a vehicle in the air is only
// taken for ours when it flies a mission. One that bounces in the mode in which it has just come down as ours still is.
// On the ground modes change as they like. Who has taken the vehicle has it
// also after its landing: an operator hands it back, or the executor when it starts the next flight. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/failsafe/events.hpp"
#include "actors/failsafe/flight_watch.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::failsafe {

// Longer than three tries of a command take, and their effect in a heartbeat.
inline constexpr std::int64_t max_expectation_ms = 60'000;

struct expected_mode {
  mode_kind kind = mode_kind::unknown;  // only read: earlier versions kept it, and it counts no more
  std::optional<std::int64_t> until_ns; // wall clock
  std::optional<std::uint32_t> custom_mode;

  GODWIT_FIELDS(expected_mode, "failsafe.expected_mode", kind, until_ns, custom_mode);
  friend bool operator==(const expected_mode&, const expected_mode&) = default;
};

struct pilot_memory {
  std::optional<flight_mode> ours; // the last mode that was
  bool taken_over = false;
  std::vector<expected_mode> expected; // in the order in which they may come

  GODWIT_FIELDS(pilot_memory, "failsafe.pilot_memory", ours, taken_over, expected);
  friend bool operator==(const pilot_memory&, const pilot_memory&) = default;
};

// What the vehicle says at a tick.
struct seen_mode {
  flight::mode_owner whose;
  flight_mode mode;
  bool is_critical = false;
  std::int64_t heard_ns = 0;              // monotonic; of the heartbeat
  std::optional<flight_mode> newest = {}; // told since: what is handed back in this moment
};

class takeover_detector {
public:
  takeover_detector(const pilot_memory& restored, const flight::plan_end& end, instant now);

  // An order, of the executor or of the failsafe itself.
  void expect(const std::vector<std::uint32_t>& modes, std::int64_t lasts_ms, instant now);
  void withdraw(const std::vector<std::uint32_t>& modes) { authority_.withdraw(modes); }
  void set_plan_end(const flight::plan_end& end);
  // A failsafe acts: from here on the plan leads nowhere by itself, and who begins it in this moment is a person.
  void forget_the_plan() {
    authority_.forget_plan_end();
    has_acted_at_begin_ = begun_ns_.has_value();
  }
  void take_over();
  void hand_back();

  void on_place(std::uint16_t sequence, bool is_complete, instant now);
  void on_text(const flight::mode_owner& whose, std::string_view text, instant now);
  // In flight, after evaluate().
  void on_current_mode(const flight::mode_owner& whose, const flight::told_modes& told, instant now);
  // Once at each tick at which the vehicle is heard.
  void evaluate(const flight_now& flight, const seen_mode& seen, instant now);

  [[nodiscard]] bool is_taken_over() const { return !adopts_ && !authority_.is_ours(); }
  // The same, and it is the autopilot's own failsafe.
  [[nodiscard]] bool is_autopilots() const { return authority_.who() == flight::holder::autopilot_failsafe; }
  // Who has it is told next; until then nothing is sent.
  [[nodiscard]] bool is_unclear() const { return begun_ns_ || authority_.is_unclear(); }
  [[nodiscard]] pilot_memory memory() const;

private:
  [[nodiscard]] bool begins_as_ours(const seen_mode& seen, instant now) const;
  void judge_begin(const seen_mode& seen, instant now);

  flight::control_authority authority_;
  flight::plan_end plan_end_;
  std::optional<flight_mode> last_; // in flight, ours; on the ground, any
  std::optional<std::int64_t> expected_until_wall_ns_;
  std::optional<std::int64_t> judged_ns_; // the newest heartbeat whose mode was judged: each is judged once
  std::optional<std::int64_t> begun_ns_;  // a flight that nobody is known to have begun
  bool is_found_ = false;                 // it was in the air already
  bool bounces_ = false;                  // it has just come down, and was armed ever since
  std::optional<flight_mode> came_down_;  // in this mode, as ours
  bool has_acted_at_begin_ = false;       // the failsafe has, before it was known whose flight it is
  bool adopts_ = false;                   // handed back: whatever mode comes next is ours
};

} // namespace godwit::failsafe
