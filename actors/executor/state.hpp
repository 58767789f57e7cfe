// What of the executor must survive a crash: the mission, where its flight stands, what the vehicle is being brought
// to, and how far the mission got.
//
//   event                         effects, by their kinds
//   those of progress/events.hpp  reports and answers for the service, and what progress wants looked at
//   those of preflight            what operators have to know
//   mission_arrived, _taken, deletion_told: none
//   assignment_kept, _rejected    the answer that turns it down
//   station_plan_taken, _dropped, and station_fence_taken, station_rally_taken, last_line_brought: none
//   change_commanded: none
//   change_asked, change_flown    what the service is to change, and that it is flown without its answer
//   change_stopped, change_answered, change_resolved: none
//   task_begun, task_ended        none; a task is on the disk before its first order goes out, but for hold,
//                                 return and stand down. Of an upload in flight plan_judged, as of its upload's end
//   phase_status                  the flight's phase and why, to whoever watches
//   start_resolved                 start_answer to who asked
//   station_took_over             none
//   supervision::failsafe_missed  none
//   home_kept, home_commanded, person_acted, state_set_again: none
//
// A cut-over is one event: with the upload accepted the mission of the new plan is the mission. Thread: plain values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "actors/executor/phase.hpp"
#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/preflight/bit.hpp"
#include "actors/executor/progress/core.hpp"
#include "actors/executor/progress/state.hpp"
#include "actors/executor/supervision/state.hpp"
#include "io/fields/field_table.hpp"
#include "messages/executor/types.hpp"
#include "messages/flight/flight_mode.hpp"
#include "messages/flight/home_place.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission_client/types.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::executor {

enum class task_kind {
  deploy, // bring a plan to the vehicle; with `goes_on` fly it
  start,  // fly the plan that it holds
  hold,
  resume,
  come_home,
  come_home_by_plan, // hold, and then bring the way around the fences and fly it
  stand_down,        // after a start that failed
  stand_by,          // disarmed in its mission mode: into one in which it begins nothing
  await_arming,      // disarmed: into its mission mode, in which its station arms it next
  free_home          // after a mission whose home was commanded: arming moves it again
};

GODWIT_ENUM_NAMES(task_kind, deploy, start, hold, resume, come_home, come_home_by_plan, stand_down, stand_by,
                  await_arming, free_home);

// It brings a plan to the vehicle.
[[nodiscard]] constexpr bool brings_plan(task_kind kind) {
  return kind == task_kind::deploy || kind == task_kind::come_home_by_plan;
}

// What the vehicle is being brought to.
struct task {
  std::uint64_t number = 0; // rises with each
  task_kind kind = task_kind::deploy;
  bool goes_on = false;                          // deploy: it is under way, and flies on with the new plan
  std::optional<std::uint64_t> start_key;        // of the station that waits for the answer to its start
  std::optional<std::uint32_t> mode_before = {}; // start: the vehicle's, when it began
  GODWIT_FIELDS(task, "executor.task", number, kind, goes_on, start_key, mode_before);
};

// Of a station's plan: the items that its start has asked for. The plan stays whole beside them, because the next start
// may ask for others.
struct station_part {
  std::uint16_t first = 0; // in the upload
  std::uint16_t last = 0;
  mission::document whole;
  std::vector<std::uint16_t> places; // as in station_plan, of `whole`
  GODWIT_FIELDS(station_part, "executor.station_part", first, last, whole, places);
};

// The plan of a ground station that is the mission, or the one that comes next.
struct station_plan {
  std::string mission_id;                // made for it
  std::int32_t revision = 1;             // of the mission, as long as nobody else has changed it
  std::uint32_t plan_id = 0;             // of the upload
  std::uint16_t items = 0;               // of the upload
  std::vector<std::uint16_t> places;     // for each item of the mission: of the item in the upload that it was made of
  std::optional<station_part> part = {}; // that the mission is; none: it is the whole upload
  station by = {};                       // who has uploaded it
  std::vector<std::string> ids = {};     // of the items of `places`, once an operator has changed the mission in flight
  GODWIT_FIELDS(station_plan, "executor.station_plan", mission_id, revision, plan_id, items, places, part, by, ids);
};

// A survey that the vehicle was sent away from, in the middle. Its lines are laid by where it is flown to from.
struct left_survey {
  mission::survey area;
  mission::vertex from;
  std::uint32_t lines = 0; // that are flown
  GODWIT_FIELDS(left_survey, "executor.left_survey", area, from, lines);
};

// The plan that an upload brings, until the upload is resolved.
struct deployment {
  mission::document mission;
  std::vector<io::mavlink::mission_item_int> items;
  std::optional<std::uint16_t> landing_sequence;
  std::vector<plan::planned_survey> surveys;
  std::optional<mission::assignment> asked = {}; // that it carries out in flight, until the upload is resolved
  std::optional<station_plan> station = {};      // the same of a part that a station's start asks for, or of an upload
  bool is_upload = false;                        // of a station, which waits for what becomes of it
  // The vehicle's, where it stood when the plan was brought before a flight: an arming leaves it there.
  std::optional<flight::home_place> home = {};
  std::optional<left_survey> left = {};
  GODWIT_FIELDS(deployment, "executor.deployment", mission, items, landing_sequence, surveys, asked, station, is_upload,
                home, left);
};

// -- events besides those of the progress -----------------------------------------------------------

// It is this mission now. No plan of it is on the vehicle yet.
struct mission_taken {
  mission::document mission;
  std::optional<std::string> assignment; // that it carries out; answered when the plan is on the vehicle
  bool awaits_person = false;            // also where flights start by themselves
  GODWIT_FIELDS(mission_taken, "executor.mission_taken", mission, assignment, awaits_person);
};

// The service wants other items. It waits until what goes on now is over.
struct assignment_kept {
  mission::assignment assignment;
  static constexpr auto fields = io::table("executor.assignment_kept", io::field("wish", &assignment_kept::assignment));
};

// It has been turned down.
struct assignment_rejected {
  std::string assignment_id;
  std::string reason; // sentence for people
  GODWIT_FIELDS(assignment_rejected, "executor.assignment_rejected", assignment_id, reason);
};

// An operator wants other items, and the service numbers the revision that has them.
enum class change_kind { go_to, cancel, insert };

GODWIT_ENUM_NAMES(change_kind, go_to, cancel, insert);

struct mission_change {
  std::string key;
  change_kind kind = change_kind::go_to;
  std::int32_t base_revision = 0;
  bool sets_aside = false; // this one, and no earlier one, has set the rest of the mission aside; or brings it back
  // What is flown when the service does not answer.
  std::optional<std::string> after_item_id = {};
  std::vector<mission::item> items = {};
  std::string reason = {};
  std::int64_t said_ns = 0; // by the operator, since 1970
  bool is_flown = false;    // without an answer
  bool is_stopped = false;  // since it was taken: its plan is brought, and not begun
  GODWIT_FIELDS(mission_change, "executor.mission_change", key, kind, base_revision, sets_aside, after_item_id, items,
                reason, said_ns, is_flown, is_stopped);
};

// What an operator has commanded, until the service is asked for it: the vehicle comes to a hold first.
struct commanded_change {
  change_kind kind = change_kind::go_to;
  std::optional<mission::position> to;
  std::string after;        // insert: this item; empty: what is done
  std::int64_t said_ns = 0; // since 1970
  GODWIT_FIELDS(commanded_change, "executor.commanded_change", kind, to, after, said_ns);
};

// None: it is not wanted any more.
struct change_commanded {
  std::optional<commanded_change> what;
  GODWIT_FIELDS(change_commanded, "executor.change_commanded", what);
};

// The service is told, and answers with change_outcome and the new revision.
struct change_asked {
  mission_change what;
  std::optional<std::string> after_item_id; // absent: in front of all items
  std::vector<mission::item> items;         // insert: one
  std::string reason;                       // for people
  std::vector<mission::item> set_aside;     // go_to: what comes back with cancel
  GODWIT_FIELDS(change_asked, "executor.change_asked", what, after_item_id, items, reason, set_aside);
};

// The service has not answered, and the vehicle flies MISSION, whose revision we have numbered. The service gets the
// change before all reports that follow.
struct change_flown {
  std::string key;
  mission::document mission;
  GODWIT_FIELDS(change_flown, "executor.change_flown", key, mission);
};

// An operator has stopped the vehicle, or sent it on.
struct change_stopped {
  std::string key;
  GODWIT_FIELDS(change_stopped, "executor.change_stopped", key);
};

// The service has it now, or never will: then our numbers from this change on are no revisions.
struct change_answered {
  std::string key;
  bool has_it = false;
  GODWIT_FIELDS(change_answered, "executor.change_answered", key, has_it);
};

struct change_resolved {
  std::string key;
  bool is_done = false; // the mission has them now
  GODWIT_FIELDS(change_resolved, "executor.change_settled", key, is_done);
};

// The service has another mission, or another revision of this one. It waits until what goes on now is over.
struct mission_arrived {
  mission::document mission;
  bool is_of_people = false; // brought by them: the service does not know it
  GODWIT_FIELDS(mission_arrived, "executor.mission_arrived", mission, is_of_people);
};

// The mission that has come can not be flown from here.
struct arrival_refused {
  std::int32_t revision = 0;
  GODWIT_FIELDS(arrival_refused, "executor.arrival_refused", revision);
};

// The service does not know this mission any more.
struct deletion_told {
  std::string mission_id;
  GODWIT_FIELDS(deletion_told, "executor.deletion_told", mission_id);
};

struct task_begun {
  task what;
  std::optional<deployment> brings;
  GODWIT_FIELDS(task_begun, "executor.task_begun", what, brings);
};

struct task_ended {
  std::uint64_t number = 0;
  GODWIT_FIELDS(task_ended, "executor.task_ended", number);
};

// The flight stands here from now on.
struct phase_status {
  static constexpr auto goes_out = runtime::effect_kind::at_once; // a view: also while the disk does not write
  phase now = phase::disconnected;
  pause_cause cause = pause_cause::none;
  std::string reason;     // sentence for people; empty when all is well
  bool in_flight = false; // it was started by us, and has not ended
  GODWIT_FIELDS(phase_status, "executor.stood", now, cause, reason, in_flight);
  friend bool operator==(const phase_status&, const phase_status&) = default;
};

// A station's MISSION_START has its answer.
struct start_resolved {
  start_answer answer;
  GODWIT_FIELDS(start_resolved, "executor.start_settled", answer);
};

// A ground station has uploaded a plan, and it is the mission that comes next.
struct station_plan_taken {
  station_plan plan;
  mission::document mission;
  GODWIT_FIELDS(station_plan_taken, "executor.station_plan_taken", plan, mission);
};

// Its fence, which counts for its plans from now on; none: it was cleared.
struct station_fence_taken {
  std::vector<mission::geofence> fences;
  std::optional<mission::position> breach_return_point;
  GODWIT_FIELDS(station_fence_taken, "executor.station_fence_taken", fences, breach_return_point);
};

// Its rally points, which go to the vehicle with its plans; none: they were cleared.
struct station_rally_taken {
  std::vector<io::mavlink::mission_item_int> items;
  GODWIT_FIELDS(station_rally_taken, "executor.station_rally_taken", items);
};

// What godwit has brought to the vehicle besides its plan, or may have: it clears that, and nothing of others.
struct brought_last_line {
  bool has_fence = false;
  bool has_rally = false;
  GODWIT_FIELDS(brought_last_line, "executor.brought_last_line", has_fence, has_rally);
  friend bool operator==(const brought_last_line&, const brought_last_line&) = default;
};

struct last_line_brought {
  brought_last_line what;
  GODWIT_FIELDS(last_line_brought, "executor.last_line_brought", what);
};

// Its own message has made the vehicle its person's, until it is handed back.
struct station_took_over {
  station by;
  GODWIT_FIELDS(station_took_over, "executor.station_took_over", by);
};

// Somebody else has acted on the vehicle on the ground, after its plan was brought to it.
struct person_acted {
  static constexpr auto fields = io::table("executor.person_acted");
};

// What the vehicle had forgotten over a pause it has again, as far as it took it.
struct state_set_again {
  static constexpr auto fields = io::table("executor.state_set_again");
};

// Its plan was cleared.
struct station_plan_dropped {
  static constexpr auto fields = io::table("executor.station_plan_dropped");
};

// Where the vehicle's home was when it was armed for the first take-off of the mission: there its returns lead, and
// from there its altitudes count. It is wherever the vehicle says until it has told it after that arming; from then on
// it stays.
struct kept_home {
  flight::home_place at;
  bool is_resolved = false;
  bool is_of_this_flight = false; // the vehicle has set it itself, and it stays there unless somebody moves it
  static constexpr auto fields =
      io::table("executor.kept_home", io::field("at", &kept_home::at), io::field("is_settled", &kept_home::is_resolved),
                io::field("is_of_this_flight", &kept_home::is_of_this_flight));
  friend bool operator==(const kept_home&, const kept_home&) = default;
};

struct home_kept {
  kept_home where;
  GODWIT_FIELDS(home_kept, "executor.home_kept", where);
};

// The vehicle's home is, or is no longer, where a command of ours has put it: arming does not move it then.
struct home_commanded {
  bool is_ours = false;
  GODWIT_FIELDS(home_commanded, "executor.home_commanded", is_ours);
};

// Flown without the service's answer; REVISION is ours.
struct flown_change {
  std::string key;
  std::int32_t revision = 0;
  GODWIT_FIELDS(flown_change, "executor.flown_change", key, revision);
};

// Further ones are refused until the service has answered.
inline constexpr std::size_t max_flown_changes = 32;

// Of missions that people have brought; of older ones nothing is reported any more.
inline constexpr std::size_t max_of_people = 16;

// What the service wants while something else goes on. More are turned down.
inline constexpr std::size_t max_waiting = 8;

struct state {
  std::optional<mission::document> mission;
  std::optional<mission::document> arrived;   // takes its place on the ground
  std::vector<mission::assignment> waiting;   // oldest first, bounded by max_waiting
  std::optional<std::string> assigned;        // carried out by the mission, and by no plan yet
  std::optional<std::string> last_assignment; // that was answered, or will be with its upload
  std::uint32_t cut_off_uploads = 0;          // of the assignment under way: by a crash, and then tried again
  std::optional<commanded_change> commanded;  // that the service was not asked for yet
  std::optional<mission_change> change;       // that the service was asked for, and has not resolved
  std::vector<flown_change> flown_changes;    // that the service has not answered; oldest first, bounded
  bool is_arrived_ours = false;               // `arrived` is of a change that is flown without its answer
  std::vector<mission::item> set_aside;       // by go_to: what the mission had left
  std::optional<station_plan> station;
  std::vector<mission::geofence> station_fences;
  std::optional<mission::position> station_breach_return_point;
  std::vector<io::mavlink::mission_item_int> station_rally;
  brought_last_line last_line;
  std::optional<deployment> brings; // of the upload under way
  std::optional<deployment> flown;  // on the vehicle
  std::optional<task> doing;
  std::uint64_t last_task = 0;
  phase_status status;
  std::optional<executor::station>
      person; // through which the person acts who has the vehicle; none: another way, or nobody has
  // It has flown, was resumed on the ground, was begun before, or was under way without us: a person starts it.
  bool awaits_word = false;
  // Somebody has acted on the vehicle since its plan was brought, or the mission before was called off: a person starts
  // it, also where flights that take off again start by themselves.
  bool awaits_person = false;
  bool owes_state = false;         // it flies on after a pause, and gets again what the plan had set (lost_state.hpp)
  std::optional<kept_home> home;   // of this mission
  bool has_commanded_home = false; // and has not freed it
  preflight::state preflight;
  progress::state progress;
  supervision::state supervision;
  std::string deleted_mission;        // the last one of which the service has said so
  std::vector<std::string> of_people; // missions that they have brought beside those of a service; newest last, bounded

  static constexpr int version = 1;
  static constexpr auto fields =
      io::table("executor.state", io::field("mission", &state::mission), io::field("arrived", &state::arrived),
                io::field("waiting", &state::waiting), io::field("assigned", &state::assigned),
                io::field("last_assignment", &state::last_assignment),
                io::field("cut_off_uploads", &state::cut_off_uploads), io::field("commanded", &state::commanded),
                io::field("change", &state::change), io::field("flown_changes", &state::flown_changes),
                io::field("is_arrived_ours", &state::is_arrived_ours), io::field("set_aside", &state::set_aside),
                io::field("station", &state::station), io::field("station_fences", &state::station_fences),
                io::field("station_breach_return_point", &state::station_breach_return_point),
                io::field("station_rally", &state::station_rally), io::field("last_line", &state::last_line),
                io::field("brings", &state::brings), io::field("flown", &state::flown),
                io::field("doing", &state::doing), io::field("last_task", &state::last_task),
                io::field("standing", &state::status), io::field("person", &state::person),
                io::field("awaits_word", &state::awaits_word), io::field("awaits_person", &state::awaits_person),
                io::field("owes_state", &state::owes_state), io::field("home", &state::home),
                io::field("has_commanded_home", &state::has_commanded_home), io::field("preflight", &state::preflight),
                io::field("progress", &state::progress), io::field("supervision", &state::supervision),
                io::field("deleted_mission", &state::deleted_mission), io::field("of_people", &state::of_people));
};

// From the decision to start on.
[[nodiscard]] inline bool is_flight_begun(const state& s) {
  return s.status.in_flight || (s.doing && s.doing->kind == task_kind::start);
}

// The service does not know such a mission, and gets nothing of it.
[[nodiscard]] bool is_of_people(const state& s, const std::string& mission_id);

// The durable core: keeps what was decided, and lets the progress decide.
struct durable_core {
  using state = executor::state;
  using event =
      std::variant<progress::mission_opened, progress::upload_intended, progress::start_intended,
                   progress::earlier_reports_told, progress::mission_aborted, progress::upload_ended,
                   progress::vehicle_looked_at, progress::plan_read_back, progress::found_begun, progress::start_ended,
                   progress::current_told, progress::reached_told, progress::act_told, progress::picture_told,
                   progress::came_down, progress::other_plan_found, progress::vehicle_rebooted,
                   preflight::checks_wanted, preflight::looked, preflight::acknowledged, preflight::mission_changed,
                   preflight::took_off, preflight::flight_ended, preflight::restarted, mission_arrived, mission_taken,
                   arrival_refused, deletion_told, change_commanded, change_asked, change_flown, change_stopped,
                   change_answered, change_resolved, assignment_kept, assignment_rejected, station_plan_taken,
                   station_fence_taken, station_rally_taken, last_line_brought, station_plan_dropped, task_begun,
                   task_ended, phase_status, station_took_over, start_resolved, supervision::failsafe_missed, home_kept,
                   home_commanded, person_acted, state_set_again>;
  using effect = std::variant<mission_client::report_progress, mission_client::respond_to_assignment,
                              mission_client::insert_waypoint, mission_client::replace_tail, progress::look_at_vehicle,
                              progress::read_plan_back, progress::resolve_start, progress::progress_event,
                              preflight::phase_changed, preflight::report_opened, preflight::acknowledgement_answered,
                              phase_status, start_answer, ground_port::plan_judged>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t now_ns);
  // Of earlier versions.
  static constexpr std::array<std::string_view, 1> retired{"executor.marked"};
  // What progress has to look at is asked for by whoever begins anew (core.hpp), after the first look at the vehicle.
  [[nodiscard]] static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

} // namespace godwit::executor
