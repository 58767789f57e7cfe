#include "programs/godwit-sim/missions/service.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "messages/mission/answer.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {
namespace service_test {

mission::receipt receipt_of(const answer& given) {
  EXPECT_EQ(given.status, 200U) << given.body;
  return mission::read<mission::receipt>(given.body).value_or(mission::receipt{});
}

mission::document mission_of(const answer& given) {
  EXPECT_EQ(given.status, 200U) << given.body;
  return mission::read<mission::document>(given.body).value_or(mission::document{});
}

std::vector<mission::wrong_place> places_of(const answer& given) {
  return mission::read<mission::problem>(given.body).value_or(mission::problem{}).errors;
}

std::vector<std::string> ids_of(const mission::document& of) {
  std::vector<std::string> all;
  for (const auto& each : of.items)
    all.push_back(mission::id_of(each));
  return all;
}

template <class Body>
request posted(const std::string& rest, const Body& body) {
  return post(rest, mission::to_text(body));
}

TEST(missions_service, the_mission_is_given_as_it_is) {
  judged_service service;
  EXPECT_EQ(mission_of(service.ask(get())), small_mission());
}

TEST(missions_service, nobody_without_the_token_learns_anything) {
  judged_service service;
  for (const auto* header : {"", "Bearer", "Bearer ", "Bearer nobody", "Basic YTpi", "a-token-of-tests"}) {
    auto asked = get();
    asked.authorization = header;
    const auto given = service.ask(asked);
    EXPECT_EQ(given.status, 401U) << header;
    ASSERT_EQ(given.headers.size(), 1U);
    EXPECT_EQ(given.headers[0].name, "WWW-Authenticate");
    asked.target = "/nothing";
    EXPECT_EQ(service.ask(asked).status, 401U);
  }
  auto asked = get();
  asked.authorization = "Bearer " + foreign_token;
  EXPECT_EQ(service.ask(asked).status, 403U);
  asked.authorization = "bearer " + token; // a scheme is the same in any case
  EXPECT_EQ(service.ask(asked).status, 200U);
}

TEST(missions_service, what_is_not_there_is_404_and_what_is_not_possible_405) {
  judged_service service;
  auto asked = get();
  asked.target = "/missions/" + uuid(1);
  EXPECT_EQ(service.ask(asked).status, 404U);
  EXPECT_EQ(service.ask(get("/nothing")).status, 404U);
  EXPECT_EQ(service.ask(get("/tail")).status, 405U);
  auto put = get("/mapobjects");
  put.method = "PUT";
  const auto given = service.ask(put);
  EXPECT_EQ(given.status, 405U);
  ASSERT_EQ(given.headers.size(), 1U);
  EXPECT_EQ(given.headers[0], (io::http::header{"Allow", "GET, POST"}));
}

TEST(missions_service, the_next_mission_is_the_first_that_has_not_ended) {
  judged_service service;
  auto second = small_mission();
  second.mission_id = uuid(77);
  ASSERT_TRUE(service_operations::add_mission(service.file(), second));
  auto asked = get();
  asked.target = "/vehicles/bird-1/missions/next?wait_s=0";
  const auto next = [&] { return mission::read<mission::next_mission>(service.ask(asked).body); };
  EXPECT_EQ(next(), (mission::next_mission{"bird-1", mission_id}));
  auto ended = reports(1, 1, 2);
  ended.reports.back().kind = mission::progress_kind::complete;
  EXPECT_EQ(service.ask(posted("/progress", ended)).status, 200U);
  EXPECT_EQ(next(), (mission::next_mission{"bird-1", uuid(77)}));
  auto remove = get();
  remove.target = "/missions/" + uuid(77);
  remove.method = "DELETE";
  EXPECT_EQ(service.ask(remove).status, 204U);
  EXPECT_EQ(service.ask(asked).status, 204U);
}

TEST(missions_service, a_picture_is_stored_once_before_or_after_its_observation) {
  judged_service service;
  const mission::observation_picture picture{uuid(1), uuid(9), "2026-05-04T10:16:02Z", "/9j/2Q=="};
  EXPECT_EQ(service.ask(posted("/pictures", picture)).status, 200U);
  auto again = picture;
  again.idempotency_key = uuid(2);
  EXPECT_EQ(service.ask(posted("/pictures", again)).status, 200U);
  const auto counts = row_counts(service.file());
  EXPECT_EQ(counts.at(row_kind::picture).stored, 1U);
  EXPECT_EQ(counts.at(row_kind::picture).repeated, 1U);
  for (const auto* each : {"", "/9j/2Q=", "/9j/2Q=x", "no base64!", "===="}) {
    auto wrong = picture;
    wrong.idempotency_key = uuid(3);
    wrong.jpeg = each;
    EXPECT_EQ(service.ask(posted("/pictures", wrong)).status, 422U) << each;
  }
}

TEST(missions_service, after_a_deletion_all_is_410_for_ever) {
  judged_service service;
  const auto first = posted("/progress", reports(1, 1, 2));
  EXPECT_EQ(service.ask(first).status, 200U);
  auto remove = get();
  remove.method = "DELETE";
  EXPECT_EQ(service.ask(remove).status, 204U);
  EXPECT_EQ(service.ask(remove).status, 204U);
  service.restart();
  for (const auto& asked : {get(), get("/mapobjects"), get("/mapobjects/ignored"), get("/assignments?after=2"), first,
                            posted("/waypoints", insert(2, 2, "n1")), posted("/mapobjects", observations(3, 1, 2))})
    EXPECT_EQ(service.ask(asked).status, 410U) << asked.target;
  EXPECT_FALSE(service_operations::add_mission(service.file(), small_mission()));
}

TEST(missions_service, a_repetition_of_any_post_changes_nothing_and_gets_the_same_answer) {
  judged_service service;
  const mission::tail tail{uuid(2), 3, "w1", {waypoint("click"), mission::return_home{"home-2"}}, "click"};
  const mission::ignored_item_batch ignored{uuid(4), {ignored_item(1)}};
  const request all[] = {posted("/waypoints", insert(1, 2, "n1")), posted("/tail", tail),
                         posted("/progress", reports(3, 1, 5)), posted("/mapobjects/ignored", ignored),
                         posted("/mapobjects", observations(5, 1, 500))};
  std::vector<answer> first;
  for (const auto& each : all)
    first.push_back(service.ask(each));
  const auto mission = mission_of(service.ask(get()));
  const auto counts = row_counts(service.file());
  service.restart();
  for (std::size_t i = 0; i < std::size(all); ++i) {
    EXPECT_EQ(first[i].status, 200U) << first[i].body;
    const auto again = service.ask(all[i]);
    EXPECT_EQ(again.status, first[i].status);
    EXPECT_EQ(again.body, first[i].body);
    EXPECT_EQ(again.content_type, first[i].content_type);
  }
  EXPECT_EQ(mission_of(service.ask(get())), mission);
  EXPECT_EQ(mission.revision, 4);
  for (const auto& [kind, counted] : row_counts(service.file())) {
    EXPECT_EQ(counted.stored, counts.at(kind).stored);
    EXPECT_EQ(counted.repeated, 0U);
  }
}

TEST(missions_service, a_known_key_with_another_request_is_422_and_changes_nothing) {
  judged_service service;
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", reports(1, 1, 1)))).stored, 1U);
  for (const auto& other : {posted("/progress", reports(1, 1, 2)), posted("/mapobjects", observations(1, 1, 1))}) {
    const auto given = service.ask(other);
    EXPECT_EQ(given.status, 422U);
    ASSERT_EQ(places_of(given).size(), 1U);
    EXPECT_EQ(places_of(given)[0].pointer, "/idempotency_key");
  }
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", reports(1, 1, 1)))).stored, 1U);
  EXPECT_EQ(rows_of(service.file(), mission_id, row_kind::progress).size(), 1U);
  EXPECT_TRUE(rows_of(service.file(), mission_id, row_kind::observation).empty());
}

TEST(missions_service, a_refused_change_is_refused_again_under_its_key_even_when_it_would_fit_now) {
  judged_service service;
  const auto early = posted("/progress", reports(1, 2, 3));
  EXPECT_EQ(service.ask(early).status, 409U);
  EXPECT_EQ(service.ask(posted("/progress", reports(2, 1, 1))).status, 200U);
  EXPECT_EQ(service.ask(early).status, 409U);
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", reports(3, 2, 3)))).stored, 2U);
}

TEST(missions_service, reports_have_no_gap_and_those_that_are_there_stay) {
  judged_service service;
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", reports(1, 1, 3)))), (mission::receipt{3, 0}));
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", reports(2, 2, 5)))), (mission::receipt{2, 2}));
  EXPECT_EQ(service.ask(posted("/progress", reports(3, 7, 8))).status, 409U);
  auto changed = reports(4, 5, 6);
  changed.reports[0].item_id = "w2";
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", changed))), (mission::receipt{1, 1}));
  const auto rows = rows_of(service.file(), mission_id, row_kind::progress);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[4].text, mission::to_text(report(5)));
  EXPECT_EQ(rows[4].deliveries, 2U);
  const auto counted = row_counts(service.file())[row_kind::progress];
  EXPECT_EQ(counted.repeated, 3U);
  EXPECT_EQ(counted.differing, 1U);
}

TEST(missions_service, reports_of_another_mission_are_422) {
  judged_service service;
  auto body = reports(1, 1, 2);
  for (auto& each : body.reports)
    each.mission_id = uuid(9);
  const auto given = service.ask(posted("/progress", body));
  EXPECT_EQ(given.status, 422U);
  EXPECT_EQ(places_of(given).at(0).pointer, "/reports/0/mission_id");
}

TEST(missions_service, reports_of_an_item_that_the_mission_never_had_are_422) {
  judged_service service;
  auto body = reports(1, 1, 2);
  body.reports[1].item_id = "goto-1";
  const auto given = service.ask(posted("/progress", body));
  EXPECT_EQ(given.status, 422U);
  EXPECT_EQ(places_of(given).at(0).pointer, "/reports/1/item_id");
  EXPECT_TRUE(rows_of(service.file(), mission_id, row_kind::progress).empty());
  body.idempotency_key = uuid(2);
  body.reports[1].item_id = "look-1";
  EXPECT_EQ(service.ask(posted("/waypoints", insert(3, 2, "look-1"))).status, 200U);
  EXPECT_EQ(service.ask(posted("/progress", body)).status, 200U);
}

TEST(missions_service, a_batch_in_another_cut_stores_each_row_once) {
  judged_service service;
  EXPECT_EQ(receipt_of(service.ask(posted("/mapobjects", observations(1, 1, 300)))), (mission::receipt{300, 0}));
  EXPECT_EQ(receipt_of(service.ask(posted("/mapobjects", observations(2, 201, 400)))), (mission::receipt{100, 100}));
  const auto rows = rows_of(service.file(), mission_id, row_kind::observation);
  EXPECT_EQ(rows.size(), 400U);
  EXPECT_EQ(std::ranges::count_if(rows, [](const auto& each) { return each.deliveries == 2; }), 100);
}

TEST(missions_service, a_batch_with_one_wrong_row_is_stored_not_at_all) {
  judged_service service;
  auto body = observations(1, 1, 10);
  body.observations[7].latitude = 95;
  const auto given = service.ask(posted("/mapobjects", body));
  EXPECT_EQ(given.status, 422U);
  ASSERT_EQ(places_of(given).size(), 1U);
  EXPECT_EQ(places_of(given)[0].pointer, "/observations/7/latitude");
  EXPECT_TRUE(rows_of(service.file(), mission_id, row_kind::observation).empty());
  body.observations[7].latitude = 47;
  EXPECT_EQ(service.ask(posted("/mapobjects", body)).status, 200U); // nothing was kept under the key
}

TEST(missions_service, what_is_no_json_is_400_and_what_breaks_the_schema_422) {
  judged_service service;
  EXPECT_EQ(service.ask(post("/progress", "{")).status, 400U);
  EXPECT_EQ(service.ask(post("/progress", "")).status, 400U);
  EXPECT_EQ(service.ask(post("/progress", "[]")).status, 422U);
  EXPECT_EQ(service.ask(post("/progress", "{\"\xff\":1}")).status, 400U);
  auto text = posted("/progress", reports(1, 1, 1));
  text.content_type = "text/plain";
  EXPECT_EQ(service.ask(text).status, 400U);
  EXPECT_EQ(service.ask(post("/progress", std::string(2'000'000, ' '))).status, 413U);
}

TEST(missions_service, an_insert_gives_the_mission_at_its_next_revision) {
  judged_service service;
  const auto changed = mission_of(service.ask(posted("/waypoints", insert(1, 2, "n1"))));
  EXPECT_EQ(changed.revision, 3);
  EXPECT_EQ(ids_of(changed), (std::vector<std::string>{"up", "w1", "n1", "w2", "home"}));
  EXPECT_EQ(mission_of(service.ask(get())), changed);
  auto first = insert(2, 3, "n0");
  first.after_item_id.reset();
  EXPECT_EQ(ids_of(mission_of(service.ask(posted("/waypoints", first)))).front(), "n0");
  EXPECT_EQ(rows_of(service.file(), mission_id, row_kind::change).size(), 2U);
}

TEST(missions_service, a_change_for_another_revision_or_after_a_missing_item_is_409) {
  judged_service service;
  EXPECT_EQ(service.ask(posted("/waypoints", insert(1, 1, "n1"))).status, 409U);
  EXPECT_EQ(service.ask(posted("/waypoints", insert(2, 3, "n1"))).status, 409U);
  auto missing = insert(3, 2, "n1");
  missing.after_item_id = "w9";
  EXPECT_EQ(service.ask(posted("/waypoints", missing)).status, 409U);
  EXPECT_EQ(mission_of(service.ask(get())), small_mission());
}

TEST(missions_service, an_id_is_never_used_for_another_item) {
  judged_service service;
  const auto taken = service.ask(posted("/waypoints", insert(1, 2, "w2")));
  EXPECT_EQ(taken.status, 422U);
  EXPECT_EQ(places_of(taken).at(0).pointer, "/waypoint/id");
  const mission::tail tail{uuid(2), 2, "w1", {mission::return_home{"home"}}, "w2 is gone"};
  EXPECT_EQ(ids_of(mission_of(service.ask(posted("/tail", tail)))), (std::vector<std::string>{"up", "w1", "home"}));
  auto other = insert(3, 3, "w2");
  std::get<mission::waypoint>(other.waypoint).hold_s = 5;
  const auto reused = service.ask(posted("/waypoints", other));
  EXPECT_EQ(reused.status, 422U);
  EXPECT_EQ(places_of(reused).at(0).pointer, "/waypoint/id");
  EXPECT_EQ(service.ask(posted("/waypoints", insert(4, 3, "w2"))).status, 200U); // the same item comes back
}

TEST(missions_service, a_poll_waits_unless_there_is_an_assignment) {
  judged_service service;
  const auto poll = get("/assignments?after=2&wait_s=30");
  EXPECT_TRUE(service.waits(poll));
  EXPECT_FALSE(service.waits(get("/assignments?after=2&wait_s=0")));
  EXPECT_EQ(service.ask(poll).body, R"({"assignments":[]})");
  const assignment_request wanted{{waypoint("n1"), mission::return_home{"home-2"}}, "w1", {}, {}, {}};
  const auto made = service_operations::assign(service.file(), mission_id, wanted, 1).value();
  EXPECT_EQ(made.revision, 3);
  EXPECT_FALSE(service.waits(poll));
  const auto list = mission::read<mission::assignment_list>(service.ask(poll).body).value();
  EXPECT_EQ(list.assignments, std::vector{made});
  EXPECT_TRUE(service.waits(get("/assignments?after=3&wait_s=30")));
}

mission::assignment_response response(std::uint64_t key, mission::assignment_outcome outcome) {
  mission::assignment_response made{uuid(key), outcome, {}, report(7), 4};
  if (outcome == mission::assignment_outcome::rejected)
    made.reason = "stale";
  return made;
}

TEST(missions_service, an_accepted_assignment_becomes_the_mission) {
  judged_service service;
  const assignment_request wanted{{waypoint("n1"), mission::return_home{"home-2"}}, "w1", {}, {}, {}};
  const auto made = service_operations::assign(service.file(), mission_id, wanted, 1).value();
  const auto path = "/assignments/" + made.assignment_id + "/response";
  const auto accepted = posted(path, response(1, mission::assignment_outcome::accepted));
  EXPECT_EQ(receipt_of(service.ask(accepted)), (mission::receipt{1, 0}));
  const auto mission = mission_of(service.ask(get()));
  EXPECT_EQ(mission.revision, 3);
  EXPECT_EQ(ids_of(mission), (std::vector<std::string>{"up", "w1", "n1", "home-2"}));
  EXPECT_EQ(receipt_of(service.ask(posted(path, response(2, mission::assignment_outcome::accepted)))),
            (mission::receipt{0, 1}));
  EXPECT_EQ(service.ask(posted(path, response(3, mission::assignment_outcome::rejected))).status, 409U);
  const auto unknown = "/assignments/" + uuid(77) + "/response";
  EXPECT_EQ(service.ask(posted(unknown, response(4, mission::assignment_outcome::accepted))).status, 404U);
}

TEST(missions_service, a_rejected_assignment_changes_nothing_and_is_not_given_again) {
  judged_service service;
  const auto made =
      service_operations::assign(service.file(), mission_id, {{mission::return_home{"home-2"}}, "w1", {}, 1, {}}, 1)
          .value();
  const auto path = "/assignments/" + made.assignment_id + "/response";
  EXPECT_EQ(service.ask(posted(path, response(1, mission::assignment_outcome::rejected))).status, 200U);
  EXPECT_EQ(mission_of(service.ask(get())), small_mission());
  EXPECT_TRUE(service.waits(get("/assignments?after=2")));
}

TEST(missions_service, an_assignment_that_was_overtaken_can_not_be_accepted) {
  judged_service service;
  const auto made =
      service_operations::assign(service.file(), mission_id, {{mission::return_home{"home-2"}}, "w1", {}, {}, {}}, 1)
          .value();
  EXPECT_EQ(mission_of(service.ask(posted("/waypoints", insert(1, 2, "n1")))).revision, 4); // 3 is the assignment's
  const auto path = "/assignments/" + made.assignment_id + "/response";
  EXPECT_EQ(service.ask(posted(path, response(2, mission::assignment_outcome::accepted))).status, 409U);
  EXPECT_EQ(mission_of(service.ask(get())).revision, 4);
}

TEST(missions_service, a_restarted_service_has_everything) {
  judged_service service;
  EXPECT_EQ(service.ask(posted("/progress", reports(1, 1, 4))).status, 200U);
  EXPECT_EQ(service.ask(posted("/waypoints", insert(2, 2, "n1"))).status, 200U);
  const auto before = service.ask(get()).body;
  service.restart();
  EXPECT_EQ(service.ask(get()).body, before);
  EXPECT_EQ(receipt_of(service.ask(posted("/progress", reports(3, 3, 5)))), (mission::receipt{1, 2}));
}

} // namespace service_test
} // namespace godwit::sim::missions
