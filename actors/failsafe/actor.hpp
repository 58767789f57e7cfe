// The failsafe as an actor: hears the vehicle, the ground and the executor, and acts through vehicle_link.
//
// The decisions are in core.hpp. This shell hands what it hears to the core, ticks every tick_ms, and at once for a new
// position and for what others say. It waits for nobody: not for the executor, not for an answer, not for the disk. A
// command goes out in the turn in which it was decided, after the failsafe_status that says whose it is, and before
// the record of it is handed to the journal. Where the journal takes nothing it goes on acting, and says so: a disk
// that is full must not keep a vehicle from coming home. Thread: as actor_base.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/failsafe/core.hpp"
#include "actors/failsafe/first_look.hpp"
#include "messages/failsafe/handle.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::failsafe {

// Shorter than the core waits: its answer is always about the newest command.
inline constexpr std::chrono::milliseconds answer_patience{command_answer_ms - 500};
// Each position is judged as it comes; of a stream that is faster than this, one so often, and the rest at the ticks.
inline constexpr std::int64_t min_judged_gap_ms = 50;

// Whom the failsafe speaks to besides the vehicle. Filled in while the process is composed, when the addresses of all
// actors exist, and not changed after the actors were started. LOG is called on the failsafe's thread, and waits for
// nobody.
struct peers {
  std::vector<failsafe_status_ear> ears;                           // the executor, and whoever else has to know
  std::vector<people_handle> people;                               // hear its warnings
  std::function<void(const warning&)> log = [](const warning&) {}; // so does whoever reads what the program says
};

class actor final : public runtime::durable_actor<own_handle, durable_core> {
public:
  // CONFIGURED has no objection_to.
  actor(runtime::spawn_context context, const settings& configured, vehicle_handle vehicle,
        std::shared_ptr<const peers> others);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void dispatch(const durable_core::effect&) override {}
  [[nodiscard]] bool goes_on_without_disk() const override { return true; }

private:
  [[nodiscard]] instant now() {
    const auto at = handler_time();
    return {at.monotonic_ns, at.wall_ns};
  }
  template <class M>
  auto hears();
  template <class M>
  auto is_told();
  void on_tick();
  void plan_tick(std::chrono::milliseconds delay);
  void take_heartbeat(const io::mavlink::heartbeat& m);
  void take_current_mode(const io::mavlink::current_mode& m);
  void judge_position();
  void turn();
  void execute(const effects& wanted);
  void execute(const command_vehicle& what) { due_.command = what; }
  void execute(const failsafe_status_changed&) { due_.failsafe_status_is_new = true; }
  void execute(const override_resolved& what) { answer_later(what.request_id, what.answer); }
  void execute(const guard_resolved& what);
  void execute(const warning& what);
  void execute(const runtime::condition&) {} // posted at the end of the turn
  void execute(const remember& what);
  void tell_failsafe_status();
  void command(const command_vehicle& what);
  [[nodiscard]] std::optional<vehicle_link::seen_state> known_with(std::uint64_t command_number) const;
  void post_health();
  void resolve(const command_vehicle& command, vehicle_link::command_verdict verdict);
  void look_further(bool at_tick);
  void end_look(bool is_answered);

  // What goes out together, at the end of a turn.
  struct due_things {
    std::optional<command_vehicle> command = {};
    bool failsafe_status_is_new = false;
    std::optional<remembered> record = {};
  };

  settings settings_;
  vehicle_handle vehicle_;
  std::shared_ptr<const peers> others_;
  std::optional<core> core_;
  flight::mode_owner owner_;                     // of the newest heartbeat
  std::optional<vehicle_link::seen_state> seen_; // the same
  first_look look_;
  std::uint64_t tick_number_ = 0;
  std::optional<std::int64_t> position_judged_ns_;
  due_things due_;
};

} // namespace godwit::failsafe
