#include "actors/mission_client/calls.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace calls_test {

using namespace godwit;
using namespace godwit::mission_client;

const std::string mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
const std::string key = "f2b7a9d4-52c6-4d3e-9b1a-6f0c2f4f7d10";

outbox_row report_row(std::uint32_t number) {
  outbox_row result;
  result.key = "f2b7a9d4-52c6-4d3e-9b1a-6f0c2f4f7d1" + std::to_string(number);
  result.mission_id = mission_id;
  result.order = number;
  result.body = R"({"mission_id":")" + mission_id + R"(","revision":2,"generation":3,"report_no":)" +
                std::to_string(number) + R"(,"kind":"started","at":"2026-05-04T10:15:30Z","inferred":false})";
  return result;
}

TEST(mission_client_calls, gets_name_what_they_want) {
  const settings by;
  EXPECT_EQ(get_mission(by, mission_id).target, "/missions/" + mission_id);
  EXPECT_EQ(get_progress(by, mission_id).target, "/missions/" + mission_id + "/progress");
  EXPECT_FALSE(get_progress(by, mission_id).is_post);
  const auto poll = get_assignments(by, mission_id, 7);
  EXPECT_EQ(poll.target, "/missions/" + mission_id + "/assignments?after=7&wait_s=30");
  EXPECT_GT(poll.read_timeout, std::chrono::seconds(30));
  EXPECT_EQ(get_page(by, mission_id, destination::observations, "").target,
            "/missions/" + mission_id + "/mapobjects?limit=2000");
  EXPECT_EQ(get_page(by, mission_id, destination::ignored_items, "a+b/=&").target,
            "/missions/" + mission_id + "/mapobjects/ignored?limit=2000&next=a%2Bb%2F%3D%26");
}

TEST(mission_client_calls, several_reports_become_one_batch_of_the_contract_under_one_key) {
  const auto first = report_row(1);
  const auto second = report_row(2);
  const auto call = post_progress({}, {&first, &second});
  EXPECT_EQ(call.target, "/missions/" + mission_id + "/progress");
  const auto batch = mission::read<mission::progress_batch>(call.body);
  ASSERT_TRUE(batch) << batch.error().message();
  EXPECT_EQ(batch->idempotency_key, call.key);
  ASSERT_EQ(batch->reports.size(), 2U);
  EXPECT_EQ(batch->reports[1].report_no, 2U);
  EXPECT_EQ(post_progress({}, {&first, &second}).key, call.key);
  EXPECT_NE(post_progress({}, {&first}).key, call.key);
}

TEST(mission_client_calls, a_batch_of_the_map_keeps_the_contract) {
  mapobjects_store::batch rows;
  rows.key = key;
  rows.mission_id = mission_id;
  rows.observations.push_back({"9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d",
                               mission_id,
                               "9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d",
                               mapobjects_store::observation_kind::found,
                               "vehicle",
                               {47.4, 8.5, 441.5},
                               1'777'889'744'000'000'000,
                               0.9});
  const auto call = post_batch({}, rows);
  EXPECT_EQ(call.target, "/missions/" + mission_id + "/mapobjects");
  const auto batch = mission::read<mission::observation_batch>(call.body);
  ASSERT_TRUE(batch) << batch.error().message();
  EXPECT_EQ(batch->idempotency_key, key);
  EXPECT_FALSE(batch->observations.at(0).object_id); // the service knows no name for a new one
  rows.to = mapobjects_store::destination::ignored_items;
  rows.ignored_items.push_back(
      {"5d0e4f83-7d6a-4a0f-9d4b-0a8f4be6a1c9", mission_id, "32TMT6634049690", "vehicle", 1'777'889'744'000'000'000});
  const auto ignored = post_batch({}, rows);
  EXPECT_EQ(ignored.target, "/missions/" + mission_id + "/mapobjects/ignored");
  EXPECT_TRUE(mission::read<mission::ignored_item_batch>(ignored.body));
}

TEST(mission_client_calls, responses_and_changes_go_out_as_they_were_said) {
  outbox_row row;
  row.key = key;
  row.mission_id = mission_id;
  row.body = "{}";
  row.to = destination::tail;
  EXPECT_EQ(post_row({}, row).target, "/missions/" + mission_id + "/tail");
  row.to = destination::waypoint;
  EXPECT_EQ(post_row({}, row).target, "/missions/" + mission_id + "/waypoints");
  row.to = destination::assignment_response;
  row.subject = "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11";
  const auto call = post_row({}, row);
  EXPECT_EQ(call.target, "/missions/" + mission_id + "/assignments/" + row.subject + "/response");
  EXPECT_EQ(call.body, row.body);
  EXPECT_EQ(call.key, key);
  EXPECT_TRUE(call.is_post);
}

TEST(mission_client_calls, a_picture_goes_out_with_the_name_of_its_file_and_without_its_bytes) {
  outbox_row row;
  row.key = key;
  row.mission_id = mission_id;
  row.to = destination::picture;
  row.subject = "100_1_m_o.jpg";
  row.body = mission::to_text(mission::observation_picture{key, mission_id, "2026-05-04T10:16:02Z", {}});
  const auto call = post_row({}, row);
  EXPECT_EQ(call.target, "/missions/" + mission_id + "/pictures");
  EXPECT_EQ(call.picture, row.subject);
  EXPECT_TRUE(call.body.ends_with(R"("jpeg":""})")) << call.body;
}

} // namespace calls_test
