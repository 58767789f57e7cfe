#include "programs/godwit-sim/missions/batch_calls.hpp"

#include <algorithm>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "messages/mission/answer.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/once.hpp"

namespace godwit::sim::missions {
namespace {

answer receipt_answer(const mission::receipt& receipt) { return {.body = mission::to_text(receipt), .headers = {}}; }

void count(mission::receipt& to, bool is_new) { ++(is_new ? to.stored : to.repeated); }

// ROWS, each with its id, under KIND.
template <class Row, class Id>
answer put_rows(service_file& file, const call& at, row_kind kind, const std::vector<Row>& rows, Id id) {
  mission::receipt receipt;
  for (const auto& each : rows)
    count(receipt, put_row(file, at.to.mission_id, kind, each.*id, mission::to_text(each)));
  return receipt_answer(receipt);
}

answer put_reports(service_file& file, const call& at, const std::vector<mission::progress_report>& reports) {
  if (reports.front().mission_id != at.to.mission_id) // the rules say that all of them have the same
    return wrong_place("/reports/0/mission_id", "is " + mission::in_quotes(reports.front().mission_id),
                       "the mission that the request is about");
  const auto last = at.mission.last_report_no;
  if (reports.front().report_no > last + 1)
    return problem_answer(409, "The last report that is there has the number " + std::to_string(last) +
                                   ", and the first of these " + std::to_string(reports.front().report_no) + ".");
  for (std::size_t i = 0; i < reports.size(); ++i)
    if (const auto& id = reports[i].item_id; id && !knows_item(file, at.to.mission_id, *id))
      return wrong_place("/reports/" + std::to_string(i) + "/item_id", "is " + mission::in_quotes(*id),
                         "an item that the mission has or had");
  mission::receipt receipt;
  for (const auto& each : reports)
    count(receipt,
          put_row(file, at.to.mission_id, row_kind::progress, std::to_string(each.report_no), mission::to_text(each)));
  set_last_report(file, at.to.mission_id, std::max<std::int64_t>(last, reports.back().report_no));
  return receipt_answer(receipt);
}

} // namespace

answer get_progress(service_file& file, const call& at) {
  mission::progress_status told{static_cast<std::uint32_t>(at.mission.last_report_no), {}};
  const auto number = std::to_string(at.mission.last_report_no);
  if (const auto text = row_text(file, at.to.mission_id, row_kind::progress, number))
    if (auto last = mission::read<mission::progress_report>(*text))
      told.last_report = *std::move(last);
  return {.body = mission::to_text(told), .headers = {}};
}

answer post_progress(service_file& file, const call& at) {
  return post_once<mission::progress_batch>(
      file, at, [&](const mission::progress_batch& body) { return put_reports(file, at, body.reports); });
}

answer post_map_objects(service_file& file, const call& at) {
  return post_once<mission::observation_batch>(file, at, [&](const mission::observation_batch& body) {
    return put_rows(file, at, row_kind::observation, body.observations, &mission::observation::observation_id);
  });
}

answer post_ignored(service_file& file, const call& at) {
  return post_once<mission::ignored_item_batch>(file, at, [&](const mission::ignored_item_batch& body) {
    return put_rows(file, at, row_kind::ignored_item, body.ignored_items, &mission::ignored_item::ignored_id);
  });
}

} // namespace godwit::sim::missions
