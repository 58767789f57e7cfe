// godwitd as one process in virtual time: its real actors, joined by the daemon's own code, on ports that a test holds
// the other ends of.
//
// Destroying it is SIGKILL: mailboxes and what was not committed are gone. The disk and the files outlive it. Nothing
// runs but by step(). Thread: one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "actors/executor/state.hpp"
#include "actors/executor/supervision/table.hpp"
#include "actors/health/report_port.hpp"
#include "actors/mapobjects_store/map_access.hpp"
#include "actors/telemetry_stream/hub.hpp"
#include "io/link/wire.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/operator/types.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/scan_controller/types.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_broker.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_eyes.hpp"
#include "programs/godwit-drill/flight_simulation/simulated_service.hpp"
#include "programs/godwitd/settings.hpp"
#include "runtime/assert.hpp"
#include "runtime/crash_points.hpp"
#include "runtime/simulation/simulated_journal.hpp"
#include "runtime/supervision/child_spec.hpp"

namespace godwit::drill {

// The daemon's end of a link in virtual time: what it sends waits until the world takes it, what it gets is queued as a
// real link does it. It belongs to one process, and dies with it. Thread: one.
class simulated_wire final : public io::link::wire {
public:
  using frame = std::vector<std::byte>;

  // WAKE is called when the actor has nothing left to do, as that of io::link::line.
  void open(std::function<void()> wake) {
    wake_ = std::move(wake);
    if (incoming().put(io::link::link_status{io::link::link_phase::up, {}, 0}))
      wake_();
  }

  // FROM: by which peer, as an address on a real line.
  void receive(std::span<const std::byte> bytes, io::link::peer_id from = peer) {
    if (incoming().put(from, bytes, true))
      wake_();
  }

  bool send(std::span<const std::byte> bytes, io::link::peer_id to) override {
    receivers_.push_back(to);
    sent_.emplace_back(bytes.begin(), bytes.end());
    return true;
  }

  // Frames to PEER since note_receivers(), those to everybody among them.
  void note_receivers() { receivers_.clear(); }
  [[nodiscard]] std::size_t sent_to(io::link::peer_id who) const {
    return static_cast<std::size_t>(std::ranges::count(receivers_, who) +
                                    std::ranges::count(receivers_, io::link::every_peer));
  }

  [[nodiscard]] std::vector<frame> take_sent() { return std::exchange(sent_, {}); }

private:
  static constexpr io::link::peer_id peer = 1;

  std::function<void()> wake_;
  std::vector<frame> sent_;
  std::vector<io::link::peer_id> receivers_;
};

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

// The real map without its thread: what is handed over waits until the test lets it happen, one after the other. It
// outlives the incarnations of the actor, as the writer does. Thread: the test's.
class stepped_map final : public mapobjects_store::map_access {
public:
  explicit stepped_map(const std::string& file) {
    auto opened = mapobjects_store::map_store::open({.file = {.path = file}, .rules = {}});
    GODWIT_ASSERT(opened.has_value(), "drill: the map opens");
    store_ = std::move(*opened);
  }

  [[nodiscard]] mapobjects_store::map_result<void> push(mapobjects_store::queued_work item) override {
    waiting_.push_back(std::move(item));
    return {};
  }
  [[nodiscard]] mapobjects_store::map_writer_status status() const override { return status_; }

  // False: nothing waits.
  bool step() {
    if (waiting_.empty())
      return false;
    auto item = std::move(waiting_.front());
    waiting_.pop_front();
    ++status_.changes;
    if (auto* change = std::get_if<mapobjects_store::queued_change>(&item))
      change->done(store_->transact(change->work));
    else if (auto job = std::get<mapobjects_store::queued_job>(item).start(*store_))
      static_cast<void>(store_->run(*job)); // it tells its asker itself
    return true;
  }

  void fail(const std::string& reason) {
    status_.failing = !reason.empty();
    status_.reason = reason;
  }

  [[nodiscard]] mapobjects_store::map_store& store() { return *store_; }

private:
  std::unique_ptr<mapobjects_store::map_store> store_;
  std::deque<mapobjects_store::queued_work> waiting_;
  mapobjects_store::map_writer_status status_;
};

} // namespace godwit::drill
