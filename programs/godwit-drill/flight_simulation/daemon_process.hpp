// godwitd as one process in virtual time: its real actors, joined by the daemon's own code, on ports that a test holds
// the other ends of.
//
// Destroying it is SIGKILL: mailboxes and what was not committed are gone. The disk and the files outlive it. Nothing
// runs but by step(). Thread: one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/state.hpp"
#include "actors/executor/supervision/table.hpp"
#include "actors/health/report_port.hpp"
#include "actors/telemetry_stream/hub.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/operator/types.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/scan_controller/types.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_broker.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_eyes.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_service.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_wire.hpp"
#include "programs/godwitd/settings.hpp"
#include "runtime/crash_points.hpp"
#include "runtime/simulation/simulated_journal.hpp"
#include "runtime/supervision/child_spec.hpp"

namespace godwit::drill {

class flight_record;

// What a process meets, and what is left of it.
struct process_surroundings {
  daemon::daemon_settings settings;
  runtime::simulated_disk journal;
  std::string map_file;
  executor::supervision::circumstances process; // of the next one
  std::optional<std::uint64_t> free_disk_bytes = 10ULL << 30U;
  std::int64_t wall_ahead_ns = 0;               // of the wall clock, before the true time
  std::vector<mapobjects_store::sighting> seen; // the file of sightings, which each process reads from its beginning
  eyes_faults eyes;                             // with settings.camera
  broker_world broker;                          // with settings.fleet
  std::function<void(std::string_view part, const std::string& sentence)> say;
  std::function<void(const executor::phase_status& now)> on_phase_status;
  flight_record* record = nullptr; // null: its deliveries are not looked at
};

class daemon_process {
public:
  // Since 1970, when virtual time is 0.
  static const std::int64_t wall_began_ns;

  // OUTSIDE outlives it. SEED: another one for each process.
  daemon_process(process_surroundings& outside, std::int64_t now_ns, std::uint64_t seed);
  daemon_process(const daemon_process&) = delete;
  daemon_process& operator=(const daemon_process&) = delete;
  ~daemon_process();

  [[nodiscard]] std::int64_t next_timer_ns() const;
  void pass_time_until(std::int64_t now_ns);
  // Runs one thing that can happen now, chosen by CHOICE: a message, a step of the journal's or of the map's writer.
  // False: nothing can, without time passing.
  bool step(std::uint64_t choice);
  // All of them, the journal after the messages: the order that costs least.
  void run_until_idle();
  [[nodiscard]] bool has_uncommitted() const;

  [[nodiscard]] simulated_wire& vehicle_wire();
  [[nodiscard]] simulated_wire& ground_wire();
  [[nodiscard]] const std::shared_ptr<simulated_service_port>& service_port() const;

  // -- people, and what else comes from beside
  // To the executor, as when operator_bridge is away.
  void say(const operators::command& what);
  // To operator_bridge. The function tells the answer, as soon as there is one.
  using answer = std::function<std::optional<operator_bridge::command_answer>()>;
  [[nodiscard]] answer command(const operator_bridge::operator_command& what);
  void change_control(const operator_bridge::change_control& what);
  void see(const mapobjects_store::sighting& what);
  [[nodiscard]] simulated_eyes& eyes();
  // At the control socket; the answer is there when what can happen now has happened.
  [[nodiscard]] scan_controller::decide_answer decide(const scan_controller::decide_point& what);
  [[nodiscard]] std::optional<scan_controller::points> points();            // none: nobody looks for them
  [[nodiscard]] std::optional<movement_detector::eyes_view> view_of_eyes(); // none: they are closed

  // -- faults
  // The next time that ACTOR passes POINT it throws. In place of what was planned before: a third throw on one message
  // would make a dead letter of it.
  void crash_at(const std::string& actor, runtime::crash_point point);
  // Ends its incarnation between two messages. False: there is none now.
  bool kill(const std::string& actor);
  void fail_journal(bool failing);
  // Its queue is full.
  void fill_journal(bool full);
  // The disk syncs for so long as it is held; sync_journal() is the end of one sync.
  void hold_journal(bool held);
  void sync_journal();
  // Its incarnation never comes out of a handler again.
  void hang(const std::string& actor);
  void set_wall_ahead(std::int64_t ns);
  [[nodiscard]] runtime::health_colour health(const std::string& component) const;

  // What the operator's port would show; what can happen now happens meanwhile. Null: there is none without time
  // passing.
  [[nodiscard]] std::shared_ptr<const health::report> report();
  [[nodiscard]] std::shared_ptr<const health::report> newest_report() const; // null: there was none yet
  [[nodiscard]] health::report_port::seen_health newest_health() const;
  [[nodiscard]] telemetry_stream::hub& stream(); // where its clients subscribe

  // Why the guardian wants the process to end.
  [[nodiscard]] std::optional<runtime::exit_request> wants_exit() const;
  // How the guardian sees it; what can happen now happens meanwhile.
  [[nodiscard]] runtime::child_report look_at(const std::string& actor);
  [[nodiscard]] std::uint64_t crashes(const std::string& actor) const;

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::drill
