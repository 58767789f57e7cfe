#include "tests/actors/executor/progress/flight_judge.hpp"

#include <algorithm>

namespace godwit::executor::progress::test {

void flight_judge::open(std::uint32_t number, std::size_t plan, std::size_t run, std::uint16_t start_sequence) {
  end_generation();
  auto& opened = generations_[number];
  opened.plan = plan;
  opened.run = run;
  opened.start_position = *position_at(plans_[plan].map, start_sequence);
}

void flight_judge::see(std::uint16_t sequence, std::size_t run) {
  if (generations_.empty())
    return;
  auto& newest = generations_.rbegin()->second;
  if (run >= newest.run)
    newest.seen_at = std::max(newest.seen_at, sequence);
}

void flight_judge::end_generation() {
  if (generations_.empty())
    return;
  const auto& ended = generations_.rbegin()->second;
  const auto& items = plans_[ended.plan].map.items;
  for (auto i = ended.start_position; i < items.size(); ++i)
    fail_if(items[i].last_nav_sequence && *items[i].last_nav_sequence < ended.seen_at &&
                vehicle_.has_flown(ended.run, i) && !ended.reached.contains(i),
            "the vehicle flew an item and was seen after it, and it is not reported");
}

void flight_judge::take(const assignment_answered& answer) {
  const auto& response = answer.response;
  log_.push_back("answered " + answer.assignment_id + ' ' + std::string(io::name_of(response.outcome)));
  fail_if(open_assignments_.erase(answer.assignment_id) == 0, "an assignment is answered twice");
  fail_if(reports_.empty() ? response.last_progress.has_value() : response.last_progress != reports_.back(),
          "the answer to an assignment does not tell the last report");
  const bool is_accepted = response.outcome == mission::assignment_outcome::accepted;
  const auto newest = generations_.empty() ? 0U : generations_.rbegin()->first;
  fail_if(response.generation != newest + (is_accepted ? 1U : 0U), "an answer tells a wrong generation");
}

void flight_judge::take(const mission::progress_report& report) {
  log_.push_back(text_of(report));
  fail_if(report.report_no != reports_.size() + 1, "report_no has a gap");
  fail_if(!reports_.empty() && report.generation < reports_.back().generation, "a report of an old generation");
  fail_if(!generations_.empty() && report.generation < generations_.rbegin()->first, "a report after its cut-over");
  reports_.push_back(report);
  if (report.item_id)
    take_item(report);
  else if (report.kind == mission::progress_kind::complete)
    check_complete(report);
}

void flight_judge::check_complete(const mission::progress_report& report) {
  fail_if(++completed_[report.revision] > 1, "complete twice");
  const auto& seen = generations_.at(report.generation);
  const auto& map = plans_[seen.plan].map;
  fail_if(!map.ends_mission, "complete, and a further plan follows");
  for (auto i = seen.last_position ? *seen.last_position + 1 : 0U; i < map.items.size(); ++i)
    fail_if(map.items[i].sequence_count > 0, "complete in front of an item");
}

void flight_judge::take_item(const mission::progress_report& report) {
  auto& seen = generations_.at(report.generation);
  fail_if(seen.last_index && *report.item_index < *seen.last_index, "the index goes back within a generation");
  seen.last_index = report.item_index;
  const auto& items = plans_[seen.plan].map.items;
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const auto& each) { return each.item_id == *report.item_id; });
  const bool is_left_out = found == items.end();
  fail_if(is_left_out && report.kind != mission::progress_kind::skipped, "an item of another plan");
  if (report.kind != mission::progress_kind::started)
    resolved_.insert(*report.item_id);
  if (is_left_out)
    return;
  fail_if(found->item_index != *report.item_index, "a wrong index");
  check_order(report, static_cast<std::uint32_t>(found - items.begin()));
}

void flight_judge::check_order(const mission::progress_report& report, std::uint32_t position) {
  auto& seen = generations_.at(report.generation);
  if (report.kind == mission::progress_kind::started) {
    fail_if(seen.last_position && position <= *seen.last_position, "started when it was done");
    return;
  }
  // A REACHED does not say of which plan, so that one of a foreign plan passes for ours until that plan is told.
  fail_if(report.kind == mission::progress_kind::reached && !vehicle_.has_flown(seen.run, position) &&
              !vehicle_.has_had_foreign_plan(seen.run),
          "reached, and it was not flown");
  // Items without vehicle items are told once for a plan, and may be missing in a later generation of it.
  const auto& items = plans_[seen.plan].map.items;
  auto next = seen.last_position ? *seen.last_position + 1 : std::min(position, seen.start_position);
  while (next < position && items[next].sequence_count == 0)
    ++next;
  fail_if(position != next, "an item is missing, or comes twice");
  seen.last_position = position;
  if (report.kind == mission::progress_kind::reached)
    seen.reached.insert(position);
}

void flight_judge::fail_if(bool is_wrong, std::string_view what) {
  if (!is_wrong || !violation_.empty())
    return;
  violation_ = what;
  log_.push_back("VIOLATION: " + violation_);
}

std::string flight_judge::log() const {
  std::string result;
  for (const auto& each : log_)
    result += each + '\n';
  return result;
}

} // namespace godwit::executor::progress::test
