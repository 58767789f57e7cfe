// What all parts of the executor's core decide by: the settings, the durable state, what the vehicle and the failsafe
// say, who has the vehicle, the task under way and what is wanted; and what follows from these alone.
//
// One for each core; the parts have references to it. Distances in metres, altitudes above home. Pure. Thread: one at a
// time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/control_authority/control_authority.hpp"
#include "actors/domain/mission/place_limits.hpp"
#include "actors/executor/effects.hpp"
#include "actors/executor/evidence.hpp"
#include "actors/executor/flight/command_queue.hpp"
#include "actors/executor/flight/pending_commands.hpp"
#include "actors/executor/plan/builder.hpp"
#include "actors/executor/settings.hpp"
#include "actors/executor/tasks/task_runner.hpp"
#include "actors/executor/tasks/way_around.hpp"
#include "actors/executor/traffic_view.hpp"
#include "actors/executor/view.hpp"
#include "messages/executor/known_missions.hpp"

namespace godwit::executor {

struct instant {
  std::int64_t now_ns = 0;  // monotonic
  std::int64_t wall_ns = 0; // since 1970 (UTC)
};

// How far a return around the fences is: see homecoming.hpp.
enum class homing_stage { none, holding, held, bringing, failed };
struct homing_state {
  homing_stage at = homing_stage::none;
  std::int64_t since_ns = 0;
  bool is_recalled = false; // by an incarnation that has not heard yet where the vehicle is
  std::string why;          // failed
};

// By which station a vehicle that stands disarmed in its mission mode is armed next: see start_by_arming.hpp.
struct arming_awaited {
  station by;
  std::uint16_t sequence = 0; // of the plan on the vehicle: where it is started
  std::int64_t until_ns = 0;
};

struct flight_context {
  flight_context(settings configuration, const state& durable) : configured(std::move(configuration)), s(durable) {}

  settings configured;
  const state& s; // outlives it, and changes only between two calls of the core
  vehicle_view view;
  traffic_view traffic;
  flight::control_authority authority;
  executor::evidence evidence;
  task_runner runner;
  std::optional<failsafe::failsafe_status> failsafe_status; // none: not told to this incarnation yet
  bool is_failsafe_gone = false;                            // in this flight: no plan is changed
  bool is_journal_nearly_full = false;                      // what waits for the disk is near its bound
  command_queue wanted;
  // The last mission, revision or assignment that could not be flown, for people; a new incarnation knows of none.
  std::optional<known_mission> refused;
  // The mission that a file or the page has brought last, before changes; a new incarnation has none.
  std::optional<mission::document> as_it_came;
  // A revision of the service that was not taken: it has that one, and changes are made to it.
  std::optional<std::pair<std::string, std::int32_t>> refused_revision;
  std::string refused_start; // by the vehicle, for now: why
  homing_state homing;
  // A station's arm has gone on to the vehicle, which shows it within a heartbeat or two.
  std::int64_t arming_until_ns = 0;
  std::optional<arming_awaited> awaited_arming;
  pending_commands pending;   // of stations: nothing is sent before the vehicle has answered them
  bool is_home_told = false;  // by the vehicle, since it was armed for this flight
  bool is_home_moved = false; // by somebody, in this flight
  bool was_up = false;        // it has been in the air, as far as this incarnation knows

  // The vehicle flies our plan, and godwit has it from here on.
  void adopt_flight();
  [[nodiscard]] task_runner::world world(instant now, effects& out) {
    return {s, view, authority, evidence, now.now_ns, out, known()};
  }
  // Why a start would be for nothing; empty: the vehicle is armed, or a start arms it.
  [[nodiscard]] std::string why_not_armed() const;
  // What an order says of the moment in which it was decided.
  [[nodiscard]] std::optional<vehicle_link::seen_state> known() const;
  [[nodiscard]] std::string refused_start_sentence() const;
  [[nodiscard]] std::string sentence() const; // how the flight stands, for people

  // A rover: it takes off and lands nowhere.
  [[nodiscard]] bool drives() const { return view.owner().vehicle == flight::vehicle_class::rover; }

  // -- the flight
  [[nodiscard]] bool is_in_flight() const { return s.status.in_flight; }
  [[nodiscard]] bool is_starting() const { return s.doing && s.doing->kind == task_kind::start; }
  // A person, a failsafe or the autopilot's own has had it, and nobody has handed it back.
  [[nodiscard]] bool has_person() const { return needs_hand_back(s.status.cause); }
  // By a command, or because it can not fly what was brought to it: what is brought meanwhile is not begun.
  [[nodiscard]] bool is_held() const {
    return s.status.now == phase::paused &&
           (s.status.cause == pause_cause::asked || s.status.cause == pause_cause::infeasible_plan);
  }
  // Of an upload or a start: what became of it is not known yet.
  [[nodiscard]] bool has_open_intent() const { return s.progress.upload || s.progress.start; }
  [[nodiscard]] bool is_plan_finished() const;
  [[nodiscard]] bool is_mission_finished() const;
  // Before its end, as its last report tells.
  [[nodiscard]] bool was_called_off() const;
  // No mission is under way, and the service is asked for the next one.
  [[nodiscard]] bool waits_for_next() const;
  // The service has deleted the mission; and it is not flown any more.
  [[nodiscard]] bool is_mission_deleted() const { return s.mission && s.deleted_mission == s.mission->mission_id; }
  [[nodiscard]] bool is_withdrawn() const { return is_mission_deleted() && !flies_deleted_mission(); }
  // By policy: it was begun, and is not over.
  [[nodiscard]] bool flies_deleted_mission() const;
  [[nodiscard]] bool is_on_way_home() const; // by a plan
  [[nodiscard]] bool was_called_home() const { return s.progress.paused == progress::pause_reason::aborted; }
  [[nodiscard]] bool is_plan_over() const;     // it is finished, or the vehicle is on its way home
  [[nodiscard]] bool is_mission_flown() const; // it flies to its items, and may have been commanded to hold
  [[nodiscard]] bool is_landing() const;       // the same: it comes down, or is home already
  [[nodiscard]] bool may_change_plan() const;  // of a flight
  // After a plan that ends in the air, or on a way that a rover has driven: it can be sent elsewhere.
  [[nodiscard]] bool hovers() const;

  // From the beginning of its first flight until the mission is over, or a person ends it: no other vehicle is taken.
  [[nodiscard]] bool keeps_vehicle() const {
    const bool has_flown = s.home && s.mission;
    return is_flight_begun(s) || (has_flown && !is_over(s.status.now));
  }

  // -- the vehicle
  [[nodiscard]] bool is_in_air() const; // of a rover, that it is armed says nothing
  [[nodiscard]] bool is_ardupilot() const;
  [[nodiscard]] bool is_copter() const;
  [[nodiscard]] bool plan_has_home() const { return is_ardupilot(); } // as its first item
  [[nodiscard]] bool is_left_armed() const;                           // on the ground, by the task that began last
  // By an ARM that it has acknowledged, and heard without a silence since then: nobody else may have armed it.
  [[nodiscard]] bool may_disarm() const;
  // PX4 goes back to its mission mode when it disarms in another one, or holds when the mission is done.
  [[nodiscard]] std::vector<std::uint32_t> modes_after_disarm() const;

  // -- the end of the plan on the vehicle
  [[nodiscard]] bool is_at_end_of_plan() const;    // MISSION_CURRENT has its last item that moves the vehicle
  [[nodiscard]] bool is_in_return_of_plan() const; // with which it ends
  [[nodiscard]] bool is_coming_down() const;       // in the landing or the return with which it ends
  [[nodiscard]] bool ends_on_ground() const;       // by a landing or a return
  // On the ground, where the last item of the plan leads.
  [[nodiscard]] bool came_down_as_planned(instant now) const;
  // One that godwit has brought to the vehicle: its returns end there where that is nearer than home.
  [[nodiscard]] bool is_at_rally_point(double metres, instant now) const;
  // PX4 says that a plan is complete as its return begins, and after any landing. It is when the vehicle is where the
  // plan leads: on the ground there, or in the air in a mode of the plan; and not any more when the next one is brought
  // to a vehicle that stands.
  [[nodiscard]] bool is_complete_credible(instant now) const;

  // -- home
  // After a landing on the way autopilots have moved their home to where they were armed, and anybody may move it in
  // flight; the mission's is kept.
  [[nodiscard]] bool keeps_home() const { return s.home && s.home->is_resolved; }
  // In flight: a return leads elsewhere than to the mission's home, or may.
  [[nodiscard]] bool returns_elsewhere() const;
  // By a command before it is armed; ArduPilot has it in the plan.
  [[nodiscard]] bool commands_home() const { return keeps_home() && !is_ardupilot(); }
  [[nodiscard]] std::string home_sentence() const; // where its returns lead, and how far that is off

  // Of the mission that is flown or prepared: a service has given it, or gives the next one.
  [[nodiscard]] bool has_service() const;
  // Than ground stations and the operators' page; empty: nobody. Beside a service that gives one mission after the
  // other theirs is taken while none of the service's is under way.
  [[nodiscard]] std::string who_else_brings_missions() const;
  [[nodiscard]] std::string missions_come_from_elsewhere() const; // the same as a sentence

  // -- what is left of a mission
  [[nodiscard]] bool is_same_mission(const mission::document& next) const;
  [[nodiscard]] bool has_nothing_left(const mission::document& next) const;
  [[nodiscard]] std::size_t first_item(const mission::document& mission) const; // to go on with
  // A survey that was begun goes on with the line that was begun.
  [[nodiscard]] plan::plan_from going_on(const mission::document& mission, std::size_t first_item) const;
  // It is known where the vehicle and its home are, and what it is: a plan can be made.
  [[nodiscard]] bool may_plan(instant now) const;
  // None: it is not.
  [[nodiscard]] std::optional<plan::plan_setting> setting(instant now) const;
  // Of MISSION from FIRST_ITEM on, or of the rest of it, from where the vehicle is. Errors: a sentence for people.
  [[nodiscard]] tl::expected<plan::flight_plan, std::string> plan_in_flight(const mission::document& mission,
                                                                            std::size_t first_item, instant now) const;
  [[nodiscard]] tl::expected<plan::flight_plan, std::string> plan_in_flight(const mission::document& mission,
                                                                            instant now) const;
  // From item FIRST on, a sentence for each place that is too far from home or too high above it. None: where home is,
  // is not known.
  [[nodiscard]] std::optional<std::vector<std::string>> out_of_limits(const mission::document& mission,
                                                                      std::size_t first, instant now) const;
  // The first of them, for a mission that is refused; empty: none, or it is not known.
  [[nodiscard]] std::string why_out_of_limits(const mission::document& mission, std::size_t first, instant now) const;
  // The same for one place.
  [[nodiscard]] std::optional<std::string> out_of_limits(const std::string& what, const mission::position& at,
                                                         instant now) const;
  // What an operator sends it around the fences by.
  [[nodiscard]] way_request way_between(const mission::position& from, const mission::position& to) const;

private:
  [[nodiscard]] std::optional<mission::limits_origin> limits_origin(instant now) const;
  void place_home(plan::plan_setting& where) const;
};

} // namespace godwit::executor
