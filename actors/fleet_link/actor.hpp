// The way to people who watch many vehicles through a broker, as an actor: what happens becomes an event that the
// broker gets once in effect, and what is live goes there while there is one.
//
//   executor, failsafe, health, scan_controller, guardian ──> news ──> journal ──> core ── broker_port ══ broker
//   telemetry_stream ── hub ──> core ─────────────────────────────────────────────────────────┘
//
// The decisions are in news.hpp and core.hpp. It hears and never commands: nothing that comes from the broker is read.
// Errors: health, and a sentence for people. Thread: as actor_base.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "actors/fleet_link/broker_port.hpp"
#include "actors/fleet_link/core.hpp"
#include "messages/executor/handle.hpp"
#include "messages/fleet_link/handle.hpp"
#include "runtime/durable_actor.hpp"
#include "runtime/supervision/handle.hpp"

namespace godwit::fleet_link {

// Filled in while the process is composed, before the actors start. What is empty is not asked.
struct peers {
  runtime::mailbox<runtime::asks<executor::get_flight, executor::flight_status>> flight;
  runtime::mailbox<runtime::asks<failsafe::get_failsafe_status, failsafe::failsafe_status>> failsafe;
  runtime::mailbox<runtime::asks<runtime::get_children, runtime::children>> guardian;
  // A reader of the stream's hub, for one incarnation: the next text, how everything stands first; null: there is none
  // now.
  std::function<std::function<text_ptr()>()> open_live;
  // For people. May be called by any thread and does not block.
  std::function<void(const std::string& sentence, bool is_warning)> say;
};

// A text of the hub, which comes by no mailbox.
struct live_text {
  std::string text;
  GODWIT_FIELDS(live_text, "fleet_link.live_text", text);
};

class actor final : public runtime::durable_actor<own_handle, durable_core> {
public:
  static constexpr std::chrono::seconds answer_timeout{2};
  static constexpr std::int64_t look_period_ns = 5'000'000'000; // at the actors

  // PROCESS: another number in each process.
  actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
        std::shared_ptr<broker_port> port, std::uint64_t process);
  ~actor() override; // ends the connection

protected:
  behavior_type handlers() override;
  void started() override;
  void dispatch(const durable_core::effect& each) override;
  void on_deadline() override { turn(); }

private:
  [[nodiscard]] instant now() {
    const auto at = handler_time();
    return {at.monotonic_ns, at.wall_ns};
  }
  void note(std::optional<noted> what);
  void ask_how_it_stands();
  void look_at_actors();
  void drain_stream();
  void turn();
  void note_calls(const effects& all);
  void execute(effects all);

  std::shared_ptr<const peers> others_;
  std::shared_ptr<broker_port> port_;
  std::string process_;
  core core_;
  std::function<text_ptr()> take_live_; // empty: there is no hub
  std::int64_t look_ns_ = 0;            // at the actors next
};

} // namespace godwit::fleet_link
