#include "actors/executor/progress/decision_context.hpp"

#include <utility>

#include "actors/domain/mission/utc_text.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::progress {

namespace {

mission::progress_report& add_report(decision_context& t, mission::progress_kind kind, bool is_inferred) {
  GODWIT_ASSERT(t.s.mission, "a report is about a mission");
  auto& open = *t.s.mission;
  GODWIT_ASSERT(!open.last_report || open.last_report->generation <= t.s.last_generation,
                "no report is of an older generation than the one before");
  auto& last = open.last_report.emplace();
  last.mission_id = open.mission_id;
  last.revision = open.revision;
  last.generation = t.s.last_generation;
  last.report_no = ++open.report_no;
  last.kind = kind;
  last.at = mission::utc_text(t.now_ns);
  last.inferred = is_inferred;
  return last;
}

} // namespace

void report_item(decision_context& t, mission::progress_kind kind, const mapped_item& item, bool is_inferred,
                 const item_findings& findings) {
  GODWIT_ASSERT(t.s.plan && t.s.plan->generation.number == t.s.last_generation,
                "only the newest generation is reported on");
  auto& what = add_report(t, kind, is_inferred);
  what.item_id = item.item_id;
  what.item_index = item.item_index;
  what.outcome = findings.outcome;
  what.pictures = findings.pictures;
  t.out.emplace_back(what);
}

void report_mission(decision_context& t, mission::progress_kind kind, bool is_inferred) {
  t.out.emplace_back(add_report(t, kind, is_inferred));
}

void tell(decision_context& t, progress_event_kind kind, std::string reason) {
  t.out.emplace_back(progress_event{kind, t.s.last_generation, std::move(reason)});
}

} // namespace godwit::executor::progress
