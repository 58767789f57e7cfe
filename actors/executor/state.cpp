#include "actors/executor/state.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "actors/domain/mission/version.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/executor/state_changes.hpp"
#include "actors/executor/station_plan.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

using durable_effects = std::vector<durable_core::effect>;

// The same report has the same key, whenever it is made.
std::string key_of(const mission::progress_report& report) {
  constexpr std::uint64_t reports = 0x7265706f7274; // keeps them apart from whatever else follows from a mission
  return ids::derived_uuid(report.mission_id, ids::text_of({reports, report.report_no}));
}

void give(durable_effects& out, const mission::progress_report& report) {
  out.emplace_back(mission_client::report_progress{key_of(report), report});
}

void give(durable_effects& out, const progress::assignment_answered& answer) {
  out.emplace_back(mission_client::respond_to_assignment{answer.mission_id, answer.assignment_id, answer.response});
}

template <class M>
void give(durable_effects& out, const M& other) {
  out.emplace_back(other);
}

void keep_of_people(state& s, const std::string& mission_id) {
  std::erase(s.of_people, mission_id);
  s.of_people.push_back(mission_id);
  if (s.of_people.size() > max_of_people)
    s.of_people.erase(s.of_people.begin());
}

// What the station hears that has uploaded it in flight.
void judge_upload(durable_effects& out, const state& s, ground_port::plan_verdict how) {
  if (s.brings && s.brings->is_upload)
    out.emplace_back(ground_port::plan_judged{io::mavlink::mav_mission_type::mission, s.brings->station->plan_id, how});
}

// An upload that is over leaves either the new mission or the one before.
void settle_deployment(durable_effects& out, state& s, std::uint32_t generation_before, bool was_assigned,
                       bool has_no_room) {
  using ground_port::plan_verdict;
  if (s.progress.upload || !s.brings)
    return;
  const bool has_come = s.progress.last_generation != generation_before;
  judge_upload(out, s, has_come ? plan_verdict::taken : has_no_room ? plan_verdict::no_space : plan_verdict::refused);
  if (has_come) {
    s.mission = s.brings->mission;
    if (was_assigned)
      s.set_aside.clear(); // the service wants something else now
    if (s.arrived && is_older_than_mission(s, *s.arrived))
      s.arrived.reset();
    if (s.change && (s.change->is_flown || s.mission->revision > s.change->base_revision))
      resolve_change(s, true);
    if (s.brings->station)
      s.station = std::exchange(s.brings->station, {});
    s.flown = std::move(s.brings);
    s.flown->is_upload = false;
  }
  s.brings.reset();
}

void forget_wish(state& s, const std::string& assignment_id) {
  std::erase_if(s.waiting, [&](const auto& each) { return each.assignment_id == assignment_id; });
  s.last_assignment = assignment_id;
}

void keep_wish(state& s, const std::string& assignment_id) {
  const auto found = std::ranges::find(s.waiting, assignment_id, &mission::assignment::assignment_id);
  if (s.brings && found != s.waiting.end())
    s.brings->asked = *found;
  forget_wish(s, assignment_id);
}

// Whoever died in its upload has not answered it: it waits again, or is carried out by the mission as before.
void try_again(state& s, const progress::upload_intended& intent) {
  ++s.cut_off_uploads;
  if (s.brings && s.brings->asked) {
    s.waiting.insert(s.waiting.begin(), *s.brings->asked);
    s.last_assignment.reset();
  } else {
    s.assigned = intent.assignment->assignment_id;
  }
}

template <class M>
concept of_progress = std::is_constructible_v<progress::event, M>;

template <of_progress M>
durable_effects take(state& s, const M& happened, std::int64_t now_ns) {
  const auto generation = s.progress.last_generation;
  const bool was_uploading = s.progress.upload.has_value();
  const bool was_assigned = was_uploading && s.progress.upload->intent.assignment.has_value();
  const auto intent = was_assigned ? std::optional(s.progress.upload->intent) : std::nullopt;
  durable_effects out;
  for (const auto& each : progress::apply(s.progress, progress::event(happened), now_ns))
    std::visit([&](const auto& what) { give(out, what); }, each);
  if constexpr (std::is_same_v<M, progress::upload_intended>) {
    if (happened.assignment)
      keep_wish(s, happened.assignment->assignment_id);
    s.assigned.reset();
  }
  if constexpr (std::is_same_v<M, progress::earlier_reports_told>) // nobody here remembers its flight
    s.awaits_word = s.awaits_word || (s.mission && progress::is_begun(s.progress, s.mission->mission_id));
  bool is_tried_again = false;
  if constexpr (requires { happened.is_tried_again; })
    is_tried_again = happened.is_tried_again && s.progress.last_generation == generation;
  if (was_assigned && !s.progress.upload && is_tried_again)
    try_again(s, *intent);
  else if (was_assigned && !s.progress.upload)
    s.cut_off_uploads = 0; // it is answered
  bool has_no_room = false;
  if constexpr (requires { happened.has_no_room; })
    has_no_room = happened.has_no_room;
  if (was_uploading)
    settle_deployment(out, s, generation, was_assigned, has_no_room);
  return out;
}

template <class M>
concept of_preflight = std::is_constructible_v<preflight::event, M>;

// Somebody else has had it under way, or we have and know nothing of it: people may be where it has come down.
bool is_under_way_without_us(const preflight::looked& look) {
  return std::ranges::any_of(look.what.findings, [](const preflight::finding& each) {
    return each.check == "on_ground" && each.how == preflight::verdict::fail;
  });
}

template <of_preflight M>
durable_effects take(state& s, const M& happened, std::int64_t now_ns) {
  durable_effects out;
  if constexpr (std::is_same_v<M, preflight::looked>)
    s.awaits_word = s.awaits_word || is_under_way_without_us(happened);
  for (const auto& each : preflight::apply(s.preflight, preflight::event(happened), now_ns))
    std::visit([&](const auto& what) { out.emplace_back(what); }, each);
  return out;
}

// An answer without a plan behind it.
mission_client::respond_to_assignment turned_down(const state& s, const std::string& assignment_id,
                                                  const std::string& reason) {
  mission::assignment_response response;
  response.idempotency_key = ids::derived_uuid(assignment_id, s.mission->mission_id);
  response.outcome = mission::assignment_outcome::rejected;
  response.reason = reason;
  response.last_progress = progress::last_progress(s.progress);
  response.generation = s.progress.last_generation;
  return {s.mission->mission_id, assignment_id, std::move(response)};
}

durable_effects take(state& s, const assignment_kept& happened, std::int64_t) {
  s.waiting.push_back(happened.assignment);
  return {};
}

durable_effects take(state& s, const assignment_rejected& happened, std::int64_t) {
  forget_wish(s, happened.assignment_id);
  s.cut_off_uploads = 0;
  return {turned_down(s, happened.assignment_id, happened.reason)};
}

durable_effects take(state& s, const deletion_told& happened, std::int64_t) {
  s.deleted_mission = happened.mission_id;
  return {};
}

durable_effects take(state& s, const mission_arrived& happened, std::int64_t) {
  if (s.deleted_mission == happened.mission.mission_id)
    s.deleted_mission.clear();
  s.arrived = happened.mission;
  s.is_arrived_ours = false;
  if (happened.is_of_people)
    keep_of_people(s, happened.mission.mission_id);
  return {};
}

durable_effects take(state& s, const mission_taken& happened, std::int64_t now_ns) {
  if (!s.mission || s.mission->mission_id != happened.mission.mission_id) {
    s.awaits_word = progress::is_begun(s.progress, happened.mission.mission_id);
    s.awaits_person = happened.awaits_person;
    s.flown_changes.clear();
    s.home.reset();
    s.supervision.has_landed = false;
  }
  s.mission = happened.mission;
  s.arrived.reset();
  if (happened.assignment) {
    forget_wish(s, *happened.assignment);
    s.assigned = happened.assignment;
  }
  return take(s, progress::mission_opened{happened.mission.mission_id, happened.mission.revision}, now_ns);
}

durable_effects take(state& s, const station_plan_taken& happened, std::int64_t) {
  s.station = happened.plan;
  s.arrived = happened.mission;
  keep_of_people(s, happened.mission.mission_id);
  return {};
}

// On the ground the mission is one with this fence now; one that flies keeps its own.
durable_effects take(state& s, const station_fence_taken& happened, std::int64_t) {
  s.station_fences = happened.fences;
  s.station_breach_return_point = happened.breach_return_point;
  const auto* uploaded = uploaded_mission(s);
  if (uploaded == nullptr || is_flight_begun(s))
    return {};
  auto fenced = *uploaded;
  fenced.revision = ++s.station->revision;
  mission::put_fences(fenced, happened.fences, happened.breach_return_point);
  s.arrived = std::move(fenced);
  return {};
}

durable_effects take(state& s, const station_rally_taken& happened, std::int64_t) {
  s.station_rally = happened.items;
  return {};
}

durable_effects take(state& s, const last_line_brought& happened, std::int64_t) {
  s.last_line = happened.what;
  return {};
}

// What the vehicle is said to have goes with it: whether it is cleared or not, godwit does not follow it any more.
durable_effects take(state& s, const station_plan_dropped&, std::int64_t) {
  s.arrived.reset();
  s.mission.reset();
  s.station.reset();
  s.brings.reset();
  s.flown.reset();
  s.progress.plan.reset();
  s.progress.held.clear();
  return {};
}

// Its station goes on seeing what it has uploaded: the items are found again by their ids.
void note_items_of_upload(state& s) {
  const auto* const uploaded = uploaded_mission(s);
  if (uploaded == nullptr || !s.status.in_flight)
    return;
  s.station->ids.clear();
  for (const auto& each : uploaded->items)
    s.station->ids.push_back(mission::id_of(each));
}

durable_effects take(state& s, const change_commanded& happened, std::int64_t) {
  s.commanded = happened.what;
  return {};
}

durable_effects take(state& s, const change_asked& happened, std::int64_t) {
  s.commanded.reset();
  note_items_of_upload(s);
  s.change = happened.what;
  s.change->sets_aside = !happened.set_aside.empty() || happened.what.kind == change_kind::cancel;
  s.change->after_item_id = happened.after_item_id;
  s.change->items = happened.items;
  s.change->reason = happened.reason;
  if (!happened.set_aside.empty())
    s.set_aside = happened.set_aside;
  return {order_for_service(s.mission->mission_id, *s.change)};
}

// The order is durable with the plan that follows, and so precedes all reports of it.
durable_effects take(state& s, const change_flown& happened, std::int64_t) {
  if (!s.change || s.change->key != happened.key)
    return {};
  s.change->is_flown = true;
  s.arrived = happened.mission;
  s.is_arrived_ours = true;
  s.flown_changes.push_back({happened.key, happened.mission.revision});
  return {order_for_service(happened.mission.mission_id, *s.change)};
}

durable_effects take(state& s, const change_stopped& happened, std::int64_t) {
  if (s.change && s.change->key == happened.key)
    stop_change(s);
  return {};
}

durable_effects take(state& s, const change_answered& happened, std::int64_t) {
  answer_flown_change(s, happened);
  return {};
}

durable_effects take(state& s, const change_resolved& happened, std::int64_t) {
  if (s.change && s.change->key == happened.key)
    resolve_change(s, happened.is_done);
  return {};
}

durable_effects take(state& s, const arrival_refused& happened, std::int64_t) {
  if (s.arrived && s.arrived->revision == happened.revision)
    s.arrived.reset();
  resolve_change(s, false);
  return {};
}

durable_effects take(state& s, const task_begun& happened, std::int64_t) {
  s.doing = happened.what;
  s.last_task = happened.what.number;
  if (happened.what.kind == task_kind::start)
    s.awaits_person = false;
  if (happened.brings)
    s.brings = happened.brings;
  return {};
}

durable_effects take(state& s, const task_ended& happened, std::int64_t) {
  if (s.doing && s.doing->number == happened.number)
    s.doing.reset();
  durable_effects out;
  if (s.brings && s.brings->is_upload && !s.progress.upload) { // it ended before anything went to the vehicle
    judge_upload(out, s, ground_port::plan_verdict::refused);
    s.brings.reset();
  }
  return out;
}

durable_effects take(state& s, const phase_status& happened, std::int64_t) {
  const bool has_landed = s.status.in_flight && !happened.in_flight;
  const bool is_resumed = s.status.now == phase::paused && happened.now == phase::connected;
  s.awaits_word = s.awaits_word || has_landed || is_resumed;
  if (s.home && has_landed) {
    s.home->is_resolved = true;
    s.home->is_of_this_flight = false; // the next arming moves it
  }
  if (s.status.in_flight != happened.in_flight)
    supervision::change_in_flight(s.supervision, happened.in_flight);
  s.owes_state =
      happened.in_flight && (s.owes_state || (s.status.now == phase::paused && happened.now == phase::flying));
  s.status = happened;
  if (has_landed && s.station) // from here on the next start would mean what the vehicle has
    s.station->ids.clear();
  if (!needs_hand_back(happened.cause))
    s.person.reset();
  else
    stop_change(s);
  return {happened};
}

durable_effects take(state& s, const station_took_over& happened, std::int64_t) {
  s.person = happened.by;
  return {};
}

durable_effects take(state& s, const supervision::failsafe_missed& happened, std::int64_t) {
  supervision::apply(s.supervision, happened);
  return {};
}

durable_effects take(state& s, const home_kept& happened, std::int64_t) {
  s.home = happened.where;
  return {};
}

durable_effects take(state& s, const state_set_again&, std::int64_t) {
  s.owes_state = false;
  return {};
}

durable_effects take(state& s, const person_acted&, std::int64_t) {
  s.awaits_person = true;
  return {};
}

durable_effects take(state& s, const home_commanded& happened, std::int64_t) {
  s.has_commanded_home = happened.is_ours;
  return {};
}

durable_effects take(state&, const start_resolved& happened, std::int64_t) { return {happened.answer}; }

} // namespace

bool is_of_people(const state& s, const std::string& mission_id) {
  return std::ranges::find(s.of_people, mission_id) != s.of_people.end();
}

std::vector<durable_core::effect> durable_core::apply(state& s, const event& happened, std::int64_t now_ns) {
  return std::visit([&](const auto& what) { return take(s, what, now_ns); }, happened);
}

} // namespace godwit::executor
