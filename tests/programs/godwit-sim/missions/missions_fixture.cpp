#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "messages/mission/answer.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"

namespace godwit::sim::missions {
namespace {

// What is wrong with the body of an answer, by the schema of its call; empty: nothing.
template <class Document>
std::string judge(const std::string& body) {
  const auto judged = mission::read<Document>(body);
  return judged ? std::string() : judged.error().message();
}

struct judge_row {
  endpoint where;
  std::string (*judge)(const std::string& body);
};

constexpr std::array judges{
    judge_row{endpoint::get_mission, judge<mission::document>},
    judge_row{endpoint::get_map_objects, judge<mission::map_object_page>},
    judge_row{endpoint::post_map_objects, judge<mission::receipt>},
    judge_row{endpoint::get_ignored, judge<mission::ignored_item_page>},
    judge_row{endpoint::post_ignored, judge<mission::receipt>},
    judge_row{endpoint::post_picture, judge<mission::receipt>},
    judge_row{endpoint::post_waypoints, judge<mission::document>},
    judge_row{endpoint::post_tail, judge<mission::document>},
    judge_row{endpoint::get_progress, judge<mission::progress_status>},
    judge_row{endpoint::post_progress, judge<mission::receipt>},
    judge_row{endpoint::get_assignments, judge<mission::assignment_list>},
    judge_row{endpoint::post_response, judge<mission::receipt>},
    judge_row{endpoint::get_next, judge<mission::next_mission>},
};

std::string judged(endpoint where, const answer& given) {
  if (given.status == 204)
    return given.body.empty() ? "" : "a body with 204";
  if (given.status != 200)
    return given.content_type != problem_type ? "no problem document" : judge<mission::problem>(given.body);
  for (const auto& row : judges)
    if (row.where == where)
      return given.content_type != json_type ? "no JSON" : row.judge(given.body);
  return "a success of no call of the contract";
}

} // namespace

mission::waypoint waypoint(const std::string& id) { return {id, {47.3985, 8.5465, 40}, 0, 2, std::nullopt}; }

mission::document small_mission() {
  mission::document made;
  made.mission_id = mission_id;
  made.revision = 2;
  made.items = {mission::takeoff{"up", 40}, waypoint("w1"), waypoint("w2"), mission::return_home{"home"}};
  made.return_point = {47.3977, 8.5456, 0};
  return made;
}

std::string uuid(std::uint64_t number) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "00000000-0000-4000-8000-%012llx", static_cast<unsigned long long>(number));
  return text.data();
}

mission::observation observation(std::uint64_t number) {
  return {uuid(number), uuid(1'000'000 + number), mission::observation_kind::moved, "vehicle", 47.39895, 8.54722, 441.5,
          0.9,          "2026-05-04T10:15:44Z"};
}

mission::ignored_item ignored_item(std::uint64_t number) {
  return {uuid(number), "32TMT6634049690", "vehicle", "2026-05-04T10:16:02Z"};
}

mission::map_object map_object(std::uint64_t number) {
  return {uuid(number), "vehicle", 47.3989, 8.5471, 441.5, 0.82, "2026-05-01T08:00:00Z", "2026-05-03T16:20:00Z"};
}

mission::progress_report report(std::uint32_t number) {
  return {mission_id, 2, 3, number, mission::progress_kind::reached, "w1", 1, "2026-05-04T10:15:30.25Z", false};
}

mission::progress_batch reports(std::uint64_t key, std::uint32_t first, std::uint32_t last) {
  mission::progress_batch made{uuid(key), {}};
  for (auto number = first; number <= last; ++number)
    made.reports.push_back(report(number));
  return made;
}

mission::observation_batch observations(std::uint64_t key, std::uint64_t first, std::uint64_t last) {
  mission::observation_batch made{uuid(key), {}};
  for (auto number = first; number <= last; ++number)
    made.observations.push_back(observation(number));
  return made;
}

mission::waypoint_insert insert(std::uint64_t key, std::int32_t base, const std::string& id) {
  return {uuid(key), base, "w1", waypoint(id)};
}

scratch::scratch() {
  auto form = (std::filesystem::temp_directory_path() / "godwit-missions-XXXXXX").string();
  if (::mkdtemp(form.data()) == nullptr)
    throw std::runtime_error("there is no room for files of tests");
  folder_ = form;
}

scratch::~scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string target(const std::string& rest) { return "/missions/" + mission_id + rest; }

request get(const std::string& rest) { return {"GET", target(rest), "Bearer " + token, {}, {}}; }

request post(const std::string& rest, std::string body) {
  return {"POST", target(rest), "Bearer " + token, "application/json", std::move(body)};
}

judged_service::judged_service() {
  restart();
  EXPECT_TRUE(service_operations::add_mission(*file_, small_mission()));
}

void judged_service::restart() {
  service_.reset();
  file_.reset();
  file_ = service_file::open(folder_.file("missions.db")).value();
  service_ = std::make_unique<service>(*file_, access_tokens{token, foreign_token});
}

answer judged_service::ask(const request& what, patience how_long) {
  auto given = std::get<answer>(service_->handle(what, now_ns, how_long));
  EXPECT_EQ(judged(endpoint_of(what), given), "") << what.method << " " << what.target << ": " << given.body;
  return given;
}

bool judged_service::waits(const request& what) {
  return std::holds_alternative<waiting>(service_->handle(what, now_ns, patience::some));
}

} // namespace godwit::sim::missions
