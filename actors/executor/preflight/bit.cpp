#include "actors/executor/preflight/bit.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/preflight/checks.hpp"
#include "actors/executor/progress/patience.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::preflight {

namespace {

using sentences = std::vector<std::string>;

struct turn {
  state& s;
  announcements& out;
  std::int64_t now_ns;
};

bool is_for(const state& s, std::string_view mission_id, std::int32_t revision) {
  return s.mission_id == mission_id && s.revision == revision;
}

bool is_overdue(const open_report& report, std::int64_t now_ns) {
  return report.acknowledged_by.empty() && progress::is_over(report.opened_ns, now_ns, acknowledge_within_ns);
}

// The numbers of reports go on, and what was acknowledged once for a vehicle.
void become_idle(state& s, std::string reason) {
  state fresh;
  fresh.last_report_id = s.last_report_id;
  fresh.reason = std::move(reason);
  fresh.known_open_lines = std::move(s.known_open_lines);
  s = std::move(fresh);
}

void become_failed(state& s, std::string reason) {
  s.now = phase::failed;
  s.reason = std::move(reason);
}

void become(state& s, phase now) {
  s.now = now;
  s.reason.clear();
}

std::string overdue_sentence(const open_report& report) {
  return "Report " + std::to_string(report.id) + " was not acknowledged within " +
         std::to_string(acknowledge_within_ns / 60'000'000'000) + " minutes; ask for a new look.";
}

void end_overdue(state& s, std::int64_t now_ns) {
  if (s.now == phase::awaiting_ack && is_overdue(*s.report, now_ns))
    become_failed(s, overdue_sentence(*s.report));
}

// -- a look ---------------------------------------------------------------------------------------

bool is_in(const sentences& all, const std::string& one) { return std::ranges::find(all, one) != all.end(); }

// Nothing in ALL is new to the report.
bool covers(const open_report& report, const sentences& all) {
  return std::ranges::all_of(all, [&](const std::string& each) { return is_in(report.sentences, each); });
}

void open_new_report(turn& t, const report& seen, sentences degraded) {
  auto& s = t.s;
  s.report = open_report{++s.last_report_id, std::move(degraded), t.now_ns, {}};
  become(s, phase::awaiting_ack);
  auto numbered = seen;
  numbered.id = s.report->id;
  t.out.emplace_back(report_opened{std::move(numbered), t.now_ns + acknowledge_within_ns});
}

void judge_degraded(turn& t, const report& seen) {
  auto& s = t.s;
  auto degraded = sentences_of(seen, verdict::degraded);
  std::erase_if(degraded, [&](const std::string& each) { return is_in(s.known_open_lines, each); });
  if (degraded.empty())
    return become(s, phase::pass);
  const bool is_known = s.report && covers(*s.report, degraded);
  if (is_known && !s.report->acknowledged_by.empty())
    return become(s, phase::pass);
  if (s.now == phase::failed && s.report) { // it was overdue
    const bool is_better = is_known && degraded.size() < s.report->sentences.size();
    return is_better ? open_new_report(t, seen, std::move(degraded)) : void();
  }
  if (is_known && !is_overdue(*s.report, t.now_ns))
    return become(s, phase::awaiting_ack);
  open_new_report(t, seen, std::move(degraded));
}

void judge(turn& t, const report& seen) {
  GODWIT_ASSERT(seen.overall == worst_of(seen.findings), "a report is as bad as the worst of its findings");
  switch (seen.overall) {
  case verdict::pass:
    return become(t.s, phase::pass); // the report stays: what degrades again is no news
  case verdict::degraded:
    return judge_degraded(t, seen);
  case verdict::fail:
  case verdict::skipped:
    break;
  }
  t.s.report.reset();
  const auto failing = sentences_of(seen, verdict::fail);
  become_failed(t.s, failing.empty() ? "No preflight check was made; ask for a new look." : summary_of(failing));
}

// -- the events -----------------------------------------------------------------------------------

void take(turn& t, const checks_wanted& wanted) {
  auto& s = t.s;
  const bool is_under_way = s.now != phase::idle && s.now != phase::failed;
  if (is_under_way && is_for(s, wanted.mission_id, wanted.revision))
    return;
  become_idle(s, {});
  s.now = phase::running;
  s.mission_id = wanted.mission_id;
  s.revision = wanted.revision;
}

void take(turn& t, const mission_changed& to) {
  if (t.s.now != phase::idle && !is_for(t.s, to.mission_id, to.revision))
    become_idle(t.s, "The mission was changed: what was checked before does not count for it.");
}

void take(turn& t, const looked& look) {
  if (t.s.now == phase::idle || t.s.is_flying)
    return;
  take(t, mission_changed{look.what.mission_id, look.what.revision});
  if (t.s.now != phase::idle)
    judge(t, look.what);
}

std::string why_not_taken(const state& s, const acknowledged& by, std::int64_t now_ns) {
  if (by.by.empty())
    return "Only an operator who is known by name can acknowledge a report; log in.";
  if (!s.report)
    return "No report waits for an acknowledgement.";
  if (by.report_id != s.report->id)
    return "The newest report is number " + std::to_string(s.report->id) + " and not " + std::to_string(by.report_id) +
           "; read it first.";
  return s.now == phase::failed || is_overdue(*s.report, now_ns) ? overdue_sentence(*s.report) : std::string();
}

void remember_open_lines(state& s) {
  auto& known = s.known_open_lines;
  for (const auto& each : s.report->sentences)
    if (is_about_open_line(each) && !is_in(known, each))
      known.push_back(each);
  if (known.size() > max_known_open_lines)
    known.erase(known.begin(), known.end() - max_known_open_lines);
}

void take(turn& t, const acknowledged& by) {
  auto& s = t.s;
  auto reason = why_not_taken(s, by, t.now_ns);
  const bool is_taken = reason.empty();
  if (is_taken && s.report->acknowledged_by.empty())
    s.report->acknowledged_by = cut_text(by.by, max_operator_name);
  if (is_taken)
    remember_open_lines(s);
  if (is_taken && s.now == phase::awaiting_ack)
    become(s, phase::pass);
  t.out.emplace_back(acknowledgement_answered{by.report_id, is_taken, std::move(reason)});
}

void take(turn& t, const took_off&) {
  if (t.s.now == phase::pass)
    t.s.is_flying = true;
  else if (t.s.now != phase::idle)
    become_idle(t.s, "The vehicle flies without the preflight checks.");
}

void take(turn& t, const flight_ended&) {
  if (t.s.now != phase::idle)
    become_idle(t.s, "The flight has ended: what was checked for it does not count for the next one.");
}

void take(turn& t, const restarted&) {
  const bool has_to_look = t.s.now == phase::pass || t.s.now == phase::awaiting_ack;
  if (has_to_look && !t.s.is_flying)
    become(t.s, phase::running);
}

} // namespace

announcements apply(state& s, const event& happened, std::int64_t now_ns) {
  GODWIT_ASSERT(s.now != phase::awaiting_ack || s.report, "what is awaited is the acknowledgement of a report");
  announcements result;
  turn t{s, result, now_ns};
  const auto before = s.now;
  const auto said_before = sentence_of(s);
  end_overdue(s, now_ns);
  std::visit([&](const auto& each) { take(t, each); }, happened);
  auto said = sentence_of(s);
  if (s.now != before || said != said_before)
    result.emplace_back(phase_changed{s.now, std::move(said)});
  return result;
}

bool matters(const state& s, const event& happened, std::int64_t now_ns) {
  auto after = s;
  return !apply(after, happened, now_ns).empty() || !io::equal(after, s);
}

bool is_passed(const state& s, std::string_view mission_id, std::int32_t revision) {
  return s.now == phase::pass && is_for(s, mission_id, revision);
}

std::string why_not_start(const state& s, const report& seen, std::int64_t now_ns) {
  auto after = s;
  (void)apply(after, looked{seen}, now_ns); // the news are told by whoever handles the look
  return is_passed(after, seen.mission_id, seen.revision) ? std::string() : sentence_of(after);
}

std::string sentence_of(const state& s) {
  switch (s.now) {
  case phase::idle:
    return s.reason.empty() ? "No preflight checks were asked for." : s.reason;
  case phase::running:
    return "The preflight checks are under way; wait.";
  case phase::pass:
    return s.report && !s.report->acknowledged_by.empty()
               ? "The preflight checks pass; " + s.report->acknowledged_by + " has acknowledged report " +
                     std::to_string(s.report->id) + "."
               : "The preflight checks pass.";
  case phase::awaiting_ack:
    return "Report " + std::to_string(s.report->id) +
           " waits for an operator to acknowledge it: " + summary_of(s.report->sentences);
  case phase::failed:
    break;
  }
  return s.reason;
}

} // namespace godwit::executor::preflight
