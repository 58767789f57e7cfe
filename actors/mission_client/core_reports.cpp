// How reports are numbered for the service: without a gap, and on from what it has, also where it has more than this
// journal.
#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/version.hpp"
#include "actors/domain/mission/write.hpp"
#include "actors/mission_client/decision_context.hpp"
#include "actors/mission_client/outbox/keys.hpp"
#include "runtime/assert.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::mission_client {

namespace {

using mission::progress_kind;
using mission::progress_report;

// In front of this one; what the service has is not missing.
std::uint32_t reports_missing(const mission_note& note, std::uint32_t report_no) {
  const auto told = report_no > note.sure_report_no ? note.sure_report_no : 0;
  const auto known = std::max(note.last_report_no, told);
  return report_no > known + 1 ? report_no - known - 1 : 0;
}

// Whether the service knows by its LAST report what this one says. One of an older journal is of that generation or an
// earlier one: within a generation the items come in their order.
bool is_known_by(const progress_report& last, const progress_report& report) {
  if (report.revision != last.revision)
    return report.revision < last.revision;
  if (last.kind == progress_kind::complete || last.kind == progress_kind::aborted)
    return true;
  if (!report.item_index || !last.item_index)
    return false;
  if (*report.item_index != *last.item_index)
    return *report.item_index < *last.item_index;
  return report.kind == last.kind || last.kind != progress_kind::started;
}

// False: the service has it. Else it is of the newest generation that the service knows.
bool is_news(mission_note& note, progress_report& report) {
  if (!note.service_report)
    return true;
  const auto& last = *note.service_report;
  if (report.generation > last.generation) {
    note.service_report.reset();
    return true;
  }
  if (is_known_by(last, report))
    return false;
  report.generation = last.generation;
  return true;
}

// A key stands for one content at the service.
std::string key_of(const std::string& key, std::uint32_t number_at_service) {
  return derived_key({key, std::to_string(number_at_service)});
}

bool waits_after(const outbox_row& row, const mission_note& note, std::uint64_t order) {
  return row.mission_id == note.mission_id && row.state == row_state::pending && row.order > order;
}

// Under another key, and out when this is on the disk.
void put_number(decision_context& t, outbox_row& row, progress_report& report, std::uint32_t number) {
  report.report_no = number;
  row.key = key_of(row.key, number);
  row.body = mission::to_text(report);
  row.order = t.s.next_order++;
  t.tell(row_noted{row, noted_as::waiting});
}

void leave_out_of_responses(decision_context& t, const mission_note& note, std::uint64_t order) {
  for (auto& row : t.s.rows) {
    if (row.to != destination::assignment_response || !waits_after(row, note, order))
      continue;
    auto response = mission::read<mission::assignment_response>(row.body);
    GODWIT_ASSERT(response.has_value(), "a response in the outbox is one");
    if (!response->last_progress || !is_left_out(note, *response->last_progress))
      continue;
    response->last_progress.reset();
    row.body = mission::to_text(*response);
    row.order = t.s.next_order++;
    t.tell(row_noted{row, noted_as::waiting});
  }
}

} // namespace

progress_report as_known(progress_report report, std::string_view schema_version) {
  if (!mission::knows_outcomes(schema_version)) {
    report.outcome.reset();
    report.pictures.reset();
  }
  return report;
}

bool is_left_out(const mission_note& note, const progress_report& report) {
  return report.item_id && std::ranges::find(note.left_out, *report.item_id) != note.left_out.end();
}

void leave_items_out(decision_context& t, const std::string& mission_id, const std::vector<mission::item>& items,
                     std::uint64_t order) {
  auto& note = note_of(t.s, mission_id);
  for (const auto& each : items)
    note.left_out.push_back(mission::id_of(each));
  if (note.left_out.size() > max_left_out)
    note.left_out.erase(note.left_out.begin(), note.left_out.end() - static_cast<std::ptrdiff_t>(max_left_out));
  leave_out_of_responses(t, note, order);
  std::optional<std::uint32_t> number;
  std::erase_if(t.s.rows, [&](outbox_row& row) {
    if (row.to != destination::progress || !waits_after(row, note, order))
      return false;
    auto report = mission::read<progress_report>(row.body);
    GODWIT_ASSERT(report.has_value(), "a report in the outbox is one");
    if (!number)
      number = report->report_no - 1;
    if (!is_left_out(note, *report) && report->report_no == *number + 1) {
      ++*number;
      return false;
    }
    t.tell(row_noted{row, noted_as::dropped});
    if (is_left_out(note, *report)) {
      ++t.s.resolved_rows;
      return true;
    }
    put_number(t, row, *report, ++*number);
    return false;
  });
  if (number)
    note.service_report_no = *number;
}

void note_known_items(decision_context& t, const mission::document& mission) {
  auto& left_out = note_of(t.s, mission.mission_id).left_out;
  if (left_out.empty())
    return;
  std::unordered_set<std::string_view> known;
  for (const auto& each : mission.items)
    known.insert(mission::id_of(each));
  std::erase_if(left_out, [&](const std::string& each) { return known.contains(each); });
}

std::uint32_t number_at_service(const mission_note& note, std::uint32_t report_no) {
  const auto behind = note.last_report_no > report_no ? note.last_report_no - report_no : 0;
  return note.service_report_no > behind ? note.service_report_no - behind : 1;
}

void continue_after(decision_context& t, mission_note& note, const earlier_reports& told) {
  const auto sure = note.asks_progress ? note.sure_report_no : note.service_report_no;
  note.service_report_no = note.sure_report_no = told.last_report_no;
  note.service_report = told.last_report;
  std::erase_if(t.s.rows, [&](outbox_row& row) {
    if (row.to != destination::progress || row.mission_id != note.mission_id || row.state != row_state::pending)
      return false;
    auto report = mission::read<progress_report>(row.body);
    GODWIT_ASSERT(report.has_value(), "a report in the outbox is one");
    if (report->report_no <= sure)
      return false; // the service has it, or its repetition is on its way
    t.tell(row_noted{row, noted_as::dropped});
    if (!is_news(note, *report)) {
      ++t.s.resolved_rows;
      return true;
    }
    put_number(t, row, *report, ++note.service_report_no);
    return false;
  });
}

// One that was lost on the way here, or for which there was no room, is left out of the service's numbers.
void take(decision_context& t, const report_progress& m) {
  auto& note = note_of(t.s, m.report.mission_id);
  if (m.report.report_no <= note.last_report_no || find_row(t.s.rows, m.key) != nullptr)
    return;
  auto report = as_known(m.report, t.s.schema_version);
  const auto missing = reports_missing(note, report.report_no);
  if (is_left_out(note, report) || !is_news(note, report)) {
    note.lost_reports += missing;
    note.last_report_no = m.report.report_no;
    return;
  }
  report.report_no = note.service_report_no + 1;
  const bool is_same = report.report_no == m.report.report_no && report.generation == m.report.generation;
  auto key = is_same ? m.key : key_of(m.key, report.report_no);
  if (GODWIT_PLANTED(reuse_idempotency_key) && !t.s.rows.empty())
    key = t.s.rows.back().key;
  if (!add_row(
          t,
          {.key = key, .to = destination::progress, .mission_id = report.mission_id, .body = mission::to_text(report)},
          0))
    return;
  note.lost_reports += missing;
  note.last_report_no = m.report.report_no;
  note.service_report_no = report.report_no;
  if (note.is_deleted)
    give_up(t, key, row_state::orphaned, std::string(mission_is_deleted));
}

// Where it is not answered before the next one begins, what was numbered meanwhile is not sure either.
void take(decision_context& t, const begun_anew&) {
  if (!goes_on_with_mission(t.s))
    return;
  auto& note = note_of(t.s, t.s.mission_id);
  if (!note.asks_progress)
    note.sure_report_no = note.service_report_no;
  note.asks_progress = true;
}

void take(decision_context& t, const progress_told& m) {
  auto& note = note_of(t.s, m.mission_id);
  if (!note.asks_progress)
    return;
  const auto last = m.last_report_no.value_or(0);
  if (last > note.sure_report_no) {
    const earlier_reports told{last, m.last_report};
    continue_after(t, note, told);
    t.tell(earlier_found{m.mission_id, told});
  }
  note.asks_progress = false;
}

} // namespace godwit::mission_client
