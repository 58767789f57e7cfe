// The executor as an actor: flies the mission.
//
// The decisions are in core.hpp. This shell hands what comes in to the core and executes the effects until nothing
// more comes of it: notes are applied at once, and are one write; orders go to vehicle_link when that write is on the
// disk, and a stop at once. A crash loses the steps of the task under way; the new incarnation looks at the vehicle
// before it does anything. Thread: as actor_base.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/core.hpp"
#include "actors/executor/supervision/core.hpp"
#include "messages/executor/handle.hpp"
#include "messages/failsafe/handle.hpp"
#include "messages/ground_port/handle.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/scan_controller/handle.hpp"
#include "messages/vehicle_link/handle.hpp"
#include "runtime/durable_actor.hpp"
#include "runtime/supervision/handle.hpp"

namespace godwit::executor {

// Filled in while the process is composed, before the actors start.
struct peers {
  vehicle_link::handle vehicle;
  failsafe::handle failsafe;
  std::optional<mission_client::flight_handle> client; // none without a service
  std::optional<ground_port::handle> port;             // none without ground stations
  scan_controller::flight_handle scan;
  scan_controller::flight_handle eyes; // none without a camera
  runtime::guardian_handle guardian;
  std::vector<flight_watcher> watchers;
  std::vector<viewer> viewers;
};

// The world outside of the actors. May be called by any thread and does not block.
struct outside_world {
  std::function<void(const announce& said)> tell_people;
  std::function<host_status()> read_host_status; // all but the actors
  std::function<std::vector<std::string>()> children;
  std::function<supervision::circumstances()> process;
  std::function<void(const phase_status& status)> on_phase_status; // at each change, and as each incarnation begins
};

class actor final : public runtime::durable_actor<own_handle, durable_core> {
public:
  // A command has its outcome by then; vehicle_link answers earlier.
  static constexpr std::chrono::seconds command_patience{15};
  // vehicle_link gives up earlier.
  static constexpr std::chrono::seconds look_patience{5};
  // The failsafe answers within a tick of its own.
  static constexpr std::chrono::milliseconds failsafe_status_patience{1'000};
  // A thousand items over a slow radio with losses.
  static constexpr std::chrono::seconds transfer_patience{600};
  static constexpr std::chrono::milliseconds tick_period{200};
  // The vehicle of an open flight is named to vehicle_link so often.
  static constexpr std::chrono::nanoseconds keep_period{1'000'000'000};
  // Other aircraft are shown so often.
  static constexpr std::int64_t traffic_period_ns = 1'000'000'000;
  // The guardian has its turns, or the process ends.
  static constexpr std::chrono::milliseconds guardian_patience{1'000};
  // Above those of starts, which count nanoseconds since 1970.
  static constexpr std::uint64_t keys_of_currents = std::uint64_t{1} << 63U;
  static constexpr int max_decisions_per_turn = 1'000;

  actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others, outside_world world);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void dispatch(const durable_core::effect& each) override;
  [[nodiscard]] bool goes_on_without_disk() const override { return true; } // stops have to come through

private:
  [[nodiscard]] instant now() {
    const auto at = handler_time();
    return {at.monotonic_ns, at.wall_ns};
  }
  template <class M>
  auto hears();
  void then(const effects& wanted);
  void obey(const operators::command& m, std::uint64_t request_id);
  void obey(const station_act& m, std::uint64_t request_id);
  void obey(const set_current& m, std::uint64_t request_id);
  [[nodiscard]] bool answer_current(const start_answer& m);
  void after_turn();
  void execute(const effects& wanted);
  void execute(const note& each) { commit(each.what); }
  void execute(const order& each);
  void hear_news();
  void dispatch_effect(const order& each);
  void send(const order& each);
  void execute(const give_up_transfer&);
  void execute(const watch_vehicle& each);
  void execute(const send_to_failsafe& each);
  void execute(const send_to_client& each);
  void execute(const send_to_port& each);
  void execute(const announce& each);
  void send_to_stations(io::mavlink::mav_severity severity, const std::string& sentence);
  void show_reached(const mission::progress_report& report);
  void show_phase_status(const phase_status& status);
  void send(std::uint64_t number, const vehicle_link::send_command& what);
  void send(std::uint64_t number, const vehicle_link::set_current_item& what);
  void send(std::uint64_t number, const vehicle_link::upload_plan& what) { transfer_plan(number, what); }
  void send(std::uint64_t number, const vehicle_link::download_plan& what) { transfer_plan(number, what); }
  void send(std::uint64_t number, const vehicle_link::look& what);
  void send(std::uint64_t number, const failsafe::guard_mission& what);
  template <class Q>
  void command_vehicle(std::uint64_t number, const Q& what);
  template <class Q>
  void transfer_plan(std::uint64_t number, const Q& what);
  void look_at_service();
  void ask_for_failsafe_status();
  void keep_vehicle(bool is_tick);
  void read_host_status();
  void supervise();
  void send_table();
  void ask_for_children();
  void miss_failsafe();
  void tell_survey();
  void greet_returned();
  void say_all(const std::vector<announce>& sentences);
  void post_health();
  void show_flight();
  void show_missions();
  void show_way_home();
  void show_traffic();
  [[nodiscard]] flight_status describe() const;

  settings settings_;
  std::shared_ptr<const peers> others_;
  outside_world world_;
  std::optional<core> core_;
  std::optional<supervision::core> supervisor_;
  // What the notes of this handler have led to, for the core.
  using news = std::variant<progress::look_at_vehicle, progress::read_plan_back, progress::resolve_start,
                            progress::progress_event>;
  std::deque<news> news_;
  bool is_asking_service_ = false;
  bool is_asking_failsafe_status_ = false;
  bool is_asking_children_ = false;
  bool is_sending_table_ = false;
  std::optional<bool> kept_told_; // to vehicle_link: a flight is open
  std::int64_t kept_told_ns_ = 0;
  std::optional<flight_status> shown_flight_;    // to the watchers
  std::optional<known_missions> shown_missions_; // to the viewers
  bool shows_traffic_ = false;                   // to the same: some was there
  std::int64_t traffic_shown_ns_ = 0;
  std::vector<progress::mission_record> restored_missions_; // what was reported of them may have been shown before
  std::string told_phase_;                                  // to the stations: each sentence once in a row
  std::optional<preflight::journal_facts> journal_facts_;   // as recorded last
  std::optional<preflight::operator_fact> operator_fact_;   // the same
  std::optional<preflight::camera_fact> camera_fact_;       // the same
  std::optional<preflight::program_fact> program_fact_;     // the same
  std::optional<scan_controller::survey_progress> told_survey_;
  std::uint64_t revoked_ = 0;        // orders that waited for the disk and were not meant any more
  std::set<std::uint64_t> currents_; // set_current requests that wait for their answer
};

} // namespace godwit::executor
