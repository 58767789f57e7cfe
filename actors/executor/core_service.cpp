// What the missions service tells the executor: the mission, its map, changes, and that a mission is gone.
#include <string>

#include "actors/executor/core.hpp"

namespace godwit::executor {
namespace {

// What became of the mission before, as far as only the service knows it.
std::string sentence_of(const mission_client::earlier_reports& earlier, const std::string& mission_id, bool has_ended) {
  return "the missions service has reports of mission " + mission_id + " up to number " +
         std::to_string(earlier.last_report_no) +
         " that this journal does not have: it was lost, or another vehicle has flown the mission. " +
         (has_ended ? "It has ended there and is not flown again; give it a new revision, or another mission"
                    : "A person has to start it");
}

} // namespace

effects core::on_mission(const mission_client::mission_loaded& m, instant now) {
  const auto& s = flight_.s;
  const auto& id = m.document.mission_id;
  const bool is_of_people = m.cause == mission_client::load_cause::brought;
  effects out;
  if (const auto why = why_no_mission(); is_of_people && !why.empty()) {
    out.emplace_back(announce{"mission " + id + " is not taken: " + why, true});
    return out;
  }
  service_.on_mission(m);
  if (!flight_.configured.has_service || is_of_people) // else the service gives each new run itself
    flight_.as_it_came = m.document;
  auto told = s.progress;
  if (m.earlier) {
    const progress::earlier_reports_told earlier{id, m.earlier->last_report_no, m.earlier->last_report};
    static_cast<void>(progress::apply(told, earlier, now.wall_ns));
    out.emplace_back(note{earlier});
  }
  const bool has_ended = progress::has_ended(told, id, m.document.revision);
  if (m.earlier)
    out.emplace_back(announce{sentence_of(*m.earlier, id, has_ended), true});
  if (s.mission && s.mission->mission_id == id && m.document.revision <= s.mission->revision)
    return out;
  if (s.arrived && *s.arrived == m.document)
    return out;
  if (has_ended)
    return out; // the service tells it at each start; what was flown is not flown again by itself
  out.emplace_back(note{mission_arrived{m.document, is_of_people}});
  return out;
}

std::string core::why_no_mission() const {
  return flight_.configured.has_service ? flight_.missions_come_from_elsewhere() : std::string();
}

// The journal is an older one than the reports of the service. On the ground a mission that has ended is not flown
// again; what flies is followed from where the service knows it.
effects core::on_earlier(const mission_client::earlier_found& m, instant now) {
  const auto& s = flight_.s;
  const progress::earlier_reports_told earlier{m.mission_id, m.earlier.last_report_no, m.earlier.last_report};
  auto told = s.progress;
  static_cast<void>(progress::apply(told, earlier, now.wall_ns));
  const bool is_current = s.mission && s.mission->mission_id == m.mission_id;
  const bool has_ended = is_current && progress::has_ended(told, m.mission_id, s.mission->revision);
  effects out{note{earlier}, announce{sentence_of(m.earlier, m.mission_id, has_ended), true}};
  const bool is_flown = told.plan && told.plan->generation.is_finished; // its end is seen as that of a flight
  const bool stands = !is_flight_begun(s) && !s.doing && !flight_.view.is_under_way();
  if (has_ended && !is_flown && stands && !is_over(s.status.now))
    phases_.go(out, trigger::mission_ended, "the missions service reports that it has ended");
  return out;
}

effects core::on_refused(const mission_client::mission_refused& m, instant now) {
  service_.on_refused(m, now);
  return {announce{"mission " + m.mission_id + ": " + m.reason, true}};
}

effects core::on_map(const mission_client::map_pulled& m, instant) {
  service_.on_map(m);
  return {};
}

effects core::on_assignment(const mission_client::assignment_arrived& m, instant) { return changes_.on_assignment(m); }

effects core::on_change(const mission_client::change_outcome& m, instant) { return changes_.on_change(m); }

// Of an earlier mission only what was seen for it is concerned.
effects core::on_deleted(const mission_client::mission_deleted& m, instant) {
  const auto& s = flight_.s;
  const bool is_current = s.mission && s.mission->mission_id == m.mission_id;
  effects out;
  std::string what_follows = "what was seen for it is kept on board";
  const bool comes_next = s.arrived && s.arrived->mission_id == m.mission_id;
  if (is_current || comes_next || m.mission_id == flight_.configured.mission_id) {
    out.emplace_back(note{deletion_told{m.mission_id}});
    what_follows = "it is not flown any more";
  }
  if (is_current && !flight_.is_in_flight() && flight_.flies_deleted_mission())
    what_follows = "it was begun, and is flown to its end";
  if (is_current && flight_.is_in_flight()) {
    const bool comes_home = flight_.configured.deleted_mission == deletion_policy::come_home && !flight_.has_person() &&
                            !flight_.is_coming_down();
    if (comes_home)
      flight_.wanted.put_halt(task_kind::come_home);
    what_follows = comes_home ? "the vehicle is called home" : "what goes on goes on";
  }
  out.emplace_back(announce{"the service has deleted mission " + m.mission_id + "; " + what_follows, true});
  return out;
}

effects core::on_delivered(const mission_client::mission_resolved& m, instant) {
  const auto& s = flight_.s;
  effects out;
  if (s.status.now == phase::post_flight && s.mission && s.mission->mission_id == m.mission_id)
    phases_.go(out, trigger::delivered, s.status.reason);
  return out;
}

} // namespace godwit::executor
