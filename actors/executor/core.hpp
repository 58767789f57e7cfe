// Every decision about a flight: from the mission to the delivery, through crashes, replans and pilots.
//
//   the vehicle's word ──> vehicle_view ──> control_authority: who has it?
//                               │               │
//   missions, assignments ──────┼──> wanted ────┼──> advance ──> a task, one at a time ──> task_runner ──> orders
//   operators, stations ────────┘               │       │
//                                               │       └──> notes: phase, task, progress ──> the journal
//   MISSION_CURRENT, ITEM_REACHED ──> progress ─┘
//
// The core hands what comes in to its parts (flight/), and asks them in one order what is to be done
// (core_arbiter.cpp). What must survive is noted, and applied to the durable state before the next call. So what is
// decided depends on the durable state, on what the vehicle says, and on nothing else. The caller keeps what is to wait
// for the disk back.
//
// Rules that protect people, each with a test of its own name: a new incarnation looks at the vehicle before anything;
// it arms, starts and takes off nothing; on the ground it waits for a person. A mode change in flight or during a start
// that no command of ours has caused is a person's or the autopilot's failsafe's: from then on nothing is sent until an
// operator hands back, also after a landing, and neither while a failsafe acts. The one exception is stand_by, which
// makes a disarmed vehicle safe to arm. A command that holds or returns gives up what is under way. What a step can not
// get done in a few tries ends in a pause with a reason; a hold or a return that is not obeyed leaves the phase as it
// is.
//
// Pure: no clock, no actor, no I/O. Thread: one at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "actors/executor/effects.hpp"
#include "actors/executor/flight/authority_text.hpp"
#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/flight_end.hpp"
#include "actors/executor/flight/flight_start.hpp"
#include "actors/executor/flight/homecoming.hpp"
#include "actors/executor/flight/mission_list.hpp"
#include "actors/executor/flight/operator_control.hpp"
#include "actors/executor/flight/phase_table.hpp"
#include "actors/executor/flight/plan_changes.hpp"
#include "actors/executor/flight/preparation.hpp"
#include "actors/executor/flight/recovery.hpp"
#include "actors/executor/flight/return_place.hpp"
#include "actors/executor/flight/service_view.hpp"
#include "actors/executor/flight/stations/gcs_view.hpp"
#include "actors/executor/flight/stations/plan_clearing.hpp"
#include "actors/executor/flight/stations/start_by_arming.hpp"
#include "actors/executor/flight/stations/station_acts.hpp"
#include "actors/executor/flight/task_control.hpp"
#include "actors/executor/flight/vehicle_messages.hpp"
#include "actors/executor/flight/watches/control_watch.hpp"
#include "actors/executor/flight/watches/energy_control.hpp"
#include "actors/executor/flight/watches/ground_watch.hpp"
#include "actors/executor/flight/watches/last_line.hpp"
#include "actors/executor/flight/watches/lost_state.hpp"
#include "actors/executor/flight/watches/plan_watch.hpp"
#include "actors/executor/flight/watches/standstill_watch.hpp"
#include "actors/executor/flight/watches/traffic_watch.hpp"
#include "messages/executor/types.hpp"
#include "messages/operator/types.hpp"

namespace godwit::executor {

class core {
public:
  // DURABLE outlives it, and changes only between two calls.
  core(settings configured, const state& durable) : flight_(std::move(configured), durable) {}
  core(const core&) = delete; // its parts refer to each other
  core& operator=(const core&) = delete;

  // IS_NEW_PROCESS: nobody of it has heard the vehicle before.
  [[nodiscard]] effects on_start(bool is_new_process);
  // The notes of the call before are applied to the durable state.
  void on_applied() { stations_.forget_shown(); }
  // What is to be done now: to be asked after everything else until nothing comes of it, and no later than
  // next_deadline_ns.
  [[nodiscard]] effects advance(instant now);
  [[nodiscard]] std::int64_t next_deadline_ns(instant now) const;

  // -- the vehicle
  // How the line is as this incarnation begins; then each change of it.
  [[nodiscard]] effects on_connection(const vehicle_link::connection& m, instant now);
  [[nodiscard]] effects on_vehicle(const vehicle_link::connection_changed& m, instant now);
  [[nodiscard]] effects on_vehicle(const vehicle_link::vehicle_restarted& m, instant now);
  [[nodiscard]] effects on_vehicle(const vehicle_link::foreign_act& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::heartbeat& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::current_mode& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::mission_current& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::mission_item_reached& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::statustext& m, instant now);
  [[nodiscard]] effects on_vehicle(const vehicle_link::picture_taken& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::sys_status& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::home_position& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::global_position_int& m, instant now);
  [[nodiscard]] effects on_vehicle(const io::mavlink::adsb_vehicle& m, instant now) { return hear_traffic(m, now); }
  [[nodiscard]] effects on_vehicle(const io::mavlink::collision& m, instant now) { return hear_traffic(m, now); }
  template <class M>
  [[nodiscard]] effects on_vehicle(const M& m, instant now) {
    if constexpr (requires { flight_.view.take(m, now.now_ns); })
      flight_.view.take(m, now.now_ns);
    else
      flight_.view.take(m);
    return {};
  }
  // Whether an order that has waited for the disk still goes out: not after a takeover, a failsafe or a newer order,
  // and not when its moment has passed or while it is unclear who has the vehicle. It is asked for again then, but for
  // a start or a resume. Outdated: what it was decided on has to be looked at anew.
  // While a command of a station is pending nothing goes out, and it is judged anew after that.
  enum class release { now, revoked, outdated, too_late, pending };
  static constexpr std::int64_t order_is_worth_ns = 3'000'000'000;
  [[nodiscard]] release lets_out(const order& what, instant now);
  [[nodiscard]] effects on_late(const order& what, instant now);
  [[nodiscard]] effects on_outdated(const order& what, instant now);
  [[nodiscard]] effects on_pending(const order& what, instant now);
  [[nodiscard]] effects on_revoked(const order& what);
  [[nodiscard]] effects on_command(std::uint64_t number, const vehicle_link::command_outcome& outcome, instant now);
  [[nodiscard]] effects on_transfer(std::uint64_t number, const vehicle_link::transfer::outcome& outcome, instant now);
  [[nodiscard]] effects on_looked(std::uint64_t number, const vehicle_link::looked& what, instant now);

  // -- the failsafe
  // Told at each change, and asked for by who begins anew: nothing is done before it is known.
  void on_failsafe_status(const failsafe::failsafe_status& m) { flight_.failsafe_status = m; }
  // It can not be kept up in this flight: no plan is changed.
  void on_failsafe_gone(bool is_gone) { flight_.is_failsafe_gone = is_gone; }
  [[nodiscard]] bool wants_failsafe_status() const { return !flight_.failsafe_status; }
  [[nodiscard]] effects on_guarded(std::uint64_t number, const failsafe::guard_answer& answer, bool is_answered,
                                   instant now);

  // -- the service
  [[nodiscard]] effects on_mission(const mission_client::mission_loaded& m, instant now);
  [[nodiscard]] effects on_earlier(const mission_client::earlier_found& m, instant now);
  [[nodiscard]] effects on_refused(const mission_client::mission_refused& m, instant now);
  [[nodiscard]] effects on_map(const mission_client::map_pulled& m, instant now);
  // How the service stands; asked for while a flight is prepared, because a restart forgets what was told.
  void on_service(const mission_client::service_status& m) { service_.on_status(m); }
  [[nodiscard]] bool wants_service() const { return service_.wants_status(); }
  [[nodiscard]] effects on_assignment(const mission_client::assignment_arrived& m, instant now);
  [[nodiscard]] effects on_change(const mission_client::change_outcome& m, instant now);
  [[nodiscard]] effects on_deleted(const mission_client::mission_deleted& m, instant now);
  // mission_client was away, and what it was told meanwhile is lost.
  [[nodiscard]] effects on_client_back();
  // The same of ground_port.
  void on_port_back() { stations_.forget_told(); }
  [[nodiscard]] effects on_delivered(const mission_client::mission_resolved& m, instant now);

  // -- people
  [[nodiscard]] effects on_station(const start_mission& m, instant now) { return stations_.on_start(m, now); }
  [[nodiscard]] effects on_station(const plan_taken& m, instant now) {
    return stations_.on_plan(m, recovery_.has_looked(), now);
  }
  [[nodiscard]] effects on_station(const plan_cleared& m, instant now);
  // As a start in flight: what it is answered with comes as a start_answer with KEY, or at once.
  [[nodiscard]] effects on_station(const set_current& m, std::uint64_t key, instant now);
  // What a person does through a station; the answer is given after the effects.
  [[nodiscard]] std::pair<effects, act_answer> on_station(const station_act& m, instant now);
  [[nodiscard]] effects on_station(const act_acknowledged& m, instant now);
  // What stations are to be told, when it has changed and once a second; to be asked after everything else.
  [[nodiscard]] effects tell_stations(instant now) { return stations_.tell(now); }
  // The answer tells whether the command is taken; what comes of it is told by the status of the flight.
  [[nodiscard]] operators::answer on_operator(const operators::command& m, instant now);

  // -- what a note has led to
  [[nodiscard]] effects on_news(const progress::look_at_vehicle& m, instant now);
  [[nodiscard]] effects on_news(const progress::read_plan_back& m, instant now);
  [[nodiscard]] effects on_news(const progress::resolve_start& m, instant now);
  [[nodiscard]] effects on_news(const progress::progress_event& m, instant now);

  void on_host_status(host_status seen) { preparation_.on_host_status(std::move(seen)); }
  [[nodiscard]] const vehicle_view& view() const { return flight_.view; }
  // In flight, by somebody; empty: it was not.
  [[nodiscard]] std::string home_moved() const {
    return flight_.is_home_moved ? "home was moved in flight: " + flight_.home_sentence() : std::string();
  }
  [[nodiscard]] bool keeps_vehicle() const { return flight_.keeps_vehicle(); }
  [[nodiscard]] const std::optional<preflight::dated_report>& last_look() const { return preparation_.last_look(); }
  [[nodiscard]] bool is_coming_down() const { return flight_.is_coming_down(); }
  [[nodiscard]] bool is_battery_short() const { return energy_.is_short(); } // for the way home
  // What it would take of the battery now.
  [[nodiscard]] way_home_estimate way_home(instant now) const { return energy_.way_home(now); }
  [[nodiscard]] heard_traffic traffic(instant now) const {
    return flight_.traffic.all(flight_.configured.close_traffic, now.now_ns);
  }
  // Of the operators' page; empty: one is taken.
  [[nodiscard]] std::string why_no_mission() const;
  // The missions service gets the reports and changes of that mission.
  [[nodiscard]] bool is_of_service(const std::string& mission_id) const { return !is_of_people(flight_.s, mission_id); }
  [[nodiscard]] known_missions missions() const {
    return list_missions(flight_, {service_.refusal(), stations_.refused_upload(), flight_.is_withdrawn()});
  }
  [[nodiscard]] const phase_machine& phases() const { return phases_; }
  [[nodiscard]] std::string sentence() const { return flight_.sentence(); } // how the flight stands, for people
  [[nodiscard]] std::string_view authority() const { return authority_text(flight_); } // who has the vehicle

  // Who is asked what is to be done, in this order. `ask`: true: something is under way, and the rest waits.
  struct ruling {
    std::string_view name;
    bool (core::*ask)(effects&, instant) = nullptr;
    std::string_view why; // it stands before those that follow
  };
  static constexpr std::size_t ruling_count = 18;
  [[nodiscard]] static std::span<const ruling> arbiter();
  // So often each kept the others waiting, in the order of the table.
  using ruling_counts = std::array<std::uint32_t, ruling_count>;
  [[nodiscard]] const ruling_counts& decided() const { return decided_; }

private:
  static const std::array<ruling, ruling_count> rulings;

  template <class M>
  [[nodiscard]] effects hear_traffic(const M& m, instant now) {
    flight_.traffic.take(m, now.now_ns);
    return {};
  }
  // Of other aircraft, to who sends the vehicle there; empty: nothing.
  [[nodiscard]] std::string advice_on_way(const operators::command& m, instant now) const;
  void note_of_mission(effects& out, const progress::event& what, instant now);

  [[nodiscard]] bool look(effects& out, instant now) { return recovery_.look(out, now); }
  [[nodiscard]] bool judge_holder(effects& out, instant now) {
    return watch_.check_authority(out, now) || flight_.pending.is_pending();
  }
  [[nodiscard]] bool come_home(effects& out, instant now) { return homecoming_.advance(out, now); }
  [[nodiscard]] bool halt(effects& out, instant now) { return operators_.halt(out, now); }
  [[nodiscard]] bool resolve(effects& out, instant now) { return recovery_.resolve(out, now); }
  [[nodiscard]] bool run_task(effects& out, instant now) { return tasks_.run(out, now); }
  [[nodiscard]] bool end_flight(effects& out, instant now) { return end_.end_flight(out, now); }
  [[nodiscard]] bool stand_by(effects& out, instant now) { return end_.leave_mission_mode(out, now); }
  [[nodiscard]] bool keep_home(effects& out, instant now) { return return_place_.advance(out, now); }
  [[nodiscard]] bool answer_assignment(effects& out, instant now) { return changes_.answer_assignment(out, now); }
  [[nodiscard]] bool fly_unanswered(effects& out, instant now) { return changes_.fly_unanswered(out, now); }
  [[nodiscard]] bool deploy_arrived(effects& out, instant now) { return changes_.deploy_arrived(out, now); }
  [[nodiscard]] bool follow_started(effects& out, instant now) { return start_.follow(out, now); }
  [[nodiscard]] bool take_back(effects& out, instant) { return watch_.take_back(out); }
  // What the order NUMBER is an answer to is still wanted; and may still be done.
  [[nodiscard]] bool awaits(std::uint64_t number) const;
  [[nodiscard]] permission may_go_out(const order& what, instant now);
  // An order that was not sent, as its task hears of it.
  [[nodiscard]] effects on_unsent(const order& what, const std::string& why, vehicle_link::command_verdict verdict,
                                  instant now);
  void lose_plan(effects& out, trigger what, instant now);
  [[nodiscard]] bool leave_to_person(effects& out, instant now);
  [[nodiscard]] bool bring_last_line(effects& out, instant now) { return last_line_.advance(out, now); }
  [[nodiscard]] bool begin_wanted(effects& out, instant now);
  [[nodiscard]] bool prepare(effects& out, instant now);

  flight_context flight_;
  phase_machine phases_{flight_};
  task_control tasks_{flight_, phases_};
  control_watch watch_{flight_, phases_, tasks_};
  ground_watch ground_{flight_};
  recovery recovery_{flight_, phases_, tasks_, watch_};
  energy_control energy_{flight_};
  vehicle_messages messages_;
  standstill_watch standstill_{flight_};
  traffic_watch traffic_{flight_};
  service_view service_{flight_};
  preparation preparation_{flight_, phases_, tasks_, energy_, service_};
  part_choice parts_{flight_, tasks_};
  start_by_arming arming_{flight_, tasks_, preparation_};
  flight_start start_{flight_, phases_, tasks_, watch_, preparation_, parts_, arming_};
  plan_changes changes_{flight_, phases_, tasks_};
  homecoming homecoming_{flight_, phases_, tasks_};
  operator_control operators_{flight_, phases_, tasks_, changes_, homecoming_, watch_};
  flight_end end_{flight_, phases_, tasks_, watch_};
  return_place return_place_{flight_, tasks_};
  plan_watch plan_{flight_};
  lost_state lost_state_{flight_};
  plan_clearing clearing_{flight_, phases_};
  last_line last_line_{flight_, clearing_};
  gcs_view stations_{flight_, phases_, tasks_, watch_, clearing_};
  ruling_counts decided_{};
  station_acts acts_{flight_, watch_, ground_, preparation_, operators_, arming_};
};

} // namespace godwit::executor
