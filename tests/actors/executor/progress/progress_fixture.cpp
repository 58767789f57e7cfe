#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::executor::progress::test {

plan_map map_of(const flavour& vehicle, const texts& ids, std::uint32_t index, bool ends_mission) {
  plan_map map{.first_sequence = vehicle.first_sequence,
               .total = static_cast<std::uint16_t>(ids.size()),
               .start_sequence = vehicle.first_sequence,
               .ends_mission = ends_mission,
               .items = {}};
  auto sequence = vehicle.first_sequence;
  for (const auto& each : ids) {
    map.items.push_back({each, index++, sequence, 1, sequence, sequence});
    ++sequence;
  }
  return map;
}

progress_fixture::progress_fixture(flavour which) : vehicle(std::move(which)) { take(mission_opened{"m", 1}); }

effects progress_fixture::take(const event& happened) {
  auto result = apply(s, happened, now_ns);
  for (const auto& each : result) {
    if (const auto* report = std::get_if<mission::progress_report>(&each))
      reports.push_back(*report);
    else if (const auto* answer = std::get_if<assignment_answered>(&each))
      answers.push_back(*answer);
    else if (const auto* what = std::get_if<progress_event>(&each))
      told.push_back(*what);
    else
      questions.push_back(each);
  }
  return result;
}

void progress_fixture::crash() {
  state read;
  const auto result = io::read_json(nlohmann::json::parse(io::to_json(s)), read);
  ASSERT_TRUE(result) << result.error().message();
  ASSERT_TRUE(io::equal(read, s));
  s = read;
  for (auto& each : resume(s))
    questions.push_back(each);
}

void progress_fixture::intend(const plan_map& map, std::int32_t revision, std::optional<assignment_key> assignment) {
  take(upload_intended{revision, map, vehicle.has_ids ? std::optional(plan_id) : std::nullopt, std::move(assignment)});
  next_total_ = map.total;
}

void progress_fixture::accept() {
  ++plan_id;
  total = next_total_;
  take(upload_ended{upload_verdict::accepted, vehicle.has_ids ? std::optional(plan_id) : std::nullopt, {}});
}

void progress_fixture::upload(const plan_map& map, std::int32_t revision, std::optional<assignment_key> assignment) {
  intend(map, revision, std::move(assignment));
  accept();
}

void progress_fixture::fly(const texts& ids, std::uint32_t index) {
  upload(ids, index);
  current(0);
  wait_s(3);
}

void progress_fixture::start_at(int position) { take(start_intended{sequence(position)}); }

mission_current progress_fixture::current_message(int position, mission_state how) const {
  return {.seq = sequence(position),
          .total = total,
          .mission_state = io::mavlink::number(how),
          .mission_id = vehicle.has_ids ? plan_id : 0U};
}

std::uint16_t progress_fixture::sequence(int position) const {
  return static_cast<std::uint16_t>(vehicle.first_sequence + position);
}

texts progress_fixture::said() {
  texts result;
  for (; said_ < reports.size(); ++said_)
    result.push_back(text_of(reports[said_]));
  return result;
}

texts progress_fixture::news_told() {
  texts result;
  for (; told_ < told.size(); ++told_)
    result.push_back(std::string(io::name_of(told[told_].kind)) + " g" + std::to_string(told[told_].generation));
  return result;
}

std::string text_of(const mission::progress_report& report) {
  std::string text(io::name_of(report.kind));
  if (report.item_id)
    text += ' ' + *report.item_id + '#' + std::to_string(*report.item_index);
  text += " g" + std::to_string(report.generation) + (report.inferred ? " inferred" : "");
  if (report.outcome)
    text.append(" ").append(io::name_of(*report.outcome));
  if (const auto& pictures = report.pictures)
    text += " pictures " + std::to_string(pictures->taken) +
            (pictures->planned ? " of " + std::to_string(*pictures->planned) : "") + ": " +
            std::to_string(pictures->first.value_or(-1)) + " to " + std::to_string(pictures->last.value_or(-1));
  return text;
}

} // namespace godwit::executor::progress::test
