#include <set>

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {

namespace change_test {

std::string ids_of(const mission::document& of) {
  std::string all;
  for (const auto& each : of.items)
    all += mission::id_of(each) + " ";
  return all;
}

TEST(missions_change, new_items_stand_after_theirs_and_the_rest_stays_or_goes) {
  const auto old = small_mission();
  EXPECT_EQ(ids_of(*changed_mission(old, "w1", {waypoint("n")}, rest_of_items::keep, "/x")), "up w1 n w2 home ");
  EXPECT_EQ(ids_of(*changed_mission(old, "w1", {waypoint("n")}, rest_of_items::replace, "/x")), "up w1 n ");
  EXPECT_EQ(ids_of(*changed_mission(old, {}, {waypoint("n")}, rest_of_items::keep, "/x")), "n up w1 w2 home ");
  EXPECT_EQ(ids_of(*changed_mission(old, {}, {waypoint("n")}, rest_of_items::replace, "/x")), "n ");
  EXPECT_EQ(ids_of(*changed_mission(old, "home", {waypoint("n")}, rest_of_items::replace, "/x")), "up w1 w2 home n ");
}

TEST(missions_change, an_item_that_is_missing_is_named) {
  const auto changed = changed_mission(small_mission(), "w9", {waypoint("n")}, rest_of_items::keep, "/x");
  ASSERT_FALSE(changed);
  EXPECT_EQ(std::get<missing_item>(changed.error()).id, "w9");
}

TEST(missions_change, an_id_that_stays_is_not_taken_twice_and_one_that_goes_may_come_back) {
  const auto taken =
      changed_mission(small_mission(), "w1", {waypoint("n"), waypoint("up")}, rest_of_items::replace, "/items");
  ASSERT_FALSE(taken);
  EXPECT_EQ(std::get<1>(taken.error()).at(0).pointer, "/items/1/id");
  EXPECT_EQ(ids_of(*changed_mission(small_mission(), "w1", {waypoint("w2")}, rest_of_items::replace, "/items")),
            "up w1 w2 ");
}

TEST(missions_change, the_mission_keeps_all_rules_afterwards) {
  std::vector<mission::item> many;
  for (int i = 0; i < 10'000; ++i)
    many.emplace_back(waypoint("n" + std::to_string(i)));
  EXPECT_FALSE(changed_mission(small_mission(), "w1", many, rest_of_items::replace, "/items"));
  EXPECT_TRUE(changed_mission(small_mission(), {}, many, rest_of_items::replace, "/items"));
}

} // namespace change_test

namespace pages_test {

std::vector<mission::map_object> objects(std::uint64_t first, std::uint64_t last) {
  std::vector<mission::map_object> all;
  for (auto number = first; number <= last; ++number)
    all.push_back(map_object(number));
  return all;
}

mission::map_object_page page_of(judged_service& service, const std::string& query) {
  const auto given = service.ask(get("/mapobjects" + query));
  EXPECT_EQ(given.status, 200U) << given.body;
  return mission::read<mission::map_object_page>(given.body).value_or(mission::map_object_page{});
}

TEST(missions_pages, a_place_reads_back_and_what_is_none_is_refused) {
  const page_place place{3, 1000, 100'000};
  EXPECT_EQ(parse_page_place(text_of(place)), place);
  for (const auto* text : {"", "1", "1-2", "1-2-", "1-2-3-4", "a-2-3", "1--2-3", " 1-2-3", "99999999999999999999-1-2"})
    EXPECT_FALSE(parse_page_place(text)) << text;
}

void expect_each_once(judged_service& service, std::size_t limit, std::size_t count) {
  std::set<std::string> seen;
  std::size_t rows = 0;
  const auto query = "?limit=" + std::to_string(limit);
  auto page = page_of(service, query);
  for (;;) {
    EXPECT_LE(page.map_objects.size(), limit);
    rows += page.map_objects.size();
    for (const auto& each : page.map_objects)
      seen.insert(each.object_id);
    if (!page.next)
      break;
    page = page_of(service, query + "&next=" + *page.next);
  }
  EXPECT_EQ(rows, count);
  EXPECT_EQ(seen.size(), count);
}

TEST(missions_pages, all_pages_together_have_each_object_once) {
  judged_service service;
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(1, 3)));
  for (const auto limit : {1U, 2U, 3U, 4U})
    expect_each_once(service, limit, 3);
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(1, 2500)));
  for (const auto limit : {999U, 1000U, 2000U})
    expect_each_once(service, limit, 2500);
}

TEST(missions_pages, a_page_has_a_thousand_rows_unless_asked_otherwise_and_an_empty_map_is_one_page) {
  judged_service service;
  EXPECT_EQ(page_of(service, ""), (mission::map_object_page{"1.0.0", {}, {}}));
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(1, 1001)));
  EXPECT_EQ(page_of(service, "").map_objects.size(), 1000U);
}

TEST(missions_pages, since_a_mark_there_is_only_what_has_changed) {
  judged_service service;
  auto all = objects(1, 5);
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, all));
  EXPECT_FALSE(page_of(service, "").mark) << "nobody has asked for one";
  const auto first = page_of(service, "?since=");
  ASSERT_TRUE(first.mark);
  EXPECT_FALSE(first.since);
  EXPECT_EQ(first.map_objects.size(), 5U);
  all.erase(all.begin());
  all[0].latitude = 47.25;
  all.push_back(map_object(6));
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, all));
  const auto change = page_of(service, "?since=" + *first.mark);
  EXPECT_EQ(change.since, first.mark);
  EXPECT_EQ(change.map_objects, (std::vector{all[0], all.back()}));
  EXPECT_EQ(change.removed, std::vector{map_object(1).object_id});
  const auto none = page_of(service, "?since=" + change.mark.value());
  EXPECT_TRUE(none.map_objects.empty() && none.removed && none.removed->empty());
  EXPECT_EQ(page_of(service, "?since=nobody's").map_objects.size(), 5U) << "a mark that is not known";
}

TEST(missions_pages, changes_come_page_by_page_as_well) {
  judged_service service;
  const auto mark = page_of(service, "?since=").mark.value();
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(1, 5)));
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(3, 5)));
  const auto query = "?limit=2&since=" + mark;
  std::size_t changed = 0;
  std::size_t removed = 0;
  auto page = page_of(service, query);
  for (int pages = 1;; ++pages) {
    changed += page.map_objects.size();
    removed += page.removed.value().size();
    if (!page.next)
      break;
    ASSERT_LT(pages, 9);
    page = page_of(service, query + "&next=" + *page.next);
  }
  EXPECT_EQ(changed, 3U);
  EXPECT_EQ(removed, 2U);
}

TEST(missions_pages, what_comes_while_somebody_pulls_is_not_in_his_pages) {
  judged_service service;
  std::vector<mission::ignored_item> items;
  for (std::uint64_t number = 1; number <= 10; ++number)
    items.push_back(ignored_item(number));
  ASSERT_TRUE(service_operations::add_ignored_items(service.file(), mission_id, items));
  const auto first = mission::read<mission::ignored_item_page>(service.ask(get("/mapobjects/ignored?limit=6")).body);
  const mission::ignored_item_batch batch{uuid(50), {ignored_item(11)}};
  EXPECT_EQ(service.ask(post("/mapobjects/ignored", mission::to_text(batch))).status, 200U);
  service.restart();
  const auto second = mission::read<mission::ignored_item_page>(
      service.ask(get("/mapobjects/ignored?limit=6&next=" + first->next.value())).body);
  EXPECT_EQ(second->ignored_items.size(), 4U);
  EXPECT_FALSE(second->next);
  const auto all = mission::read<mission::ignored_item_page>(service.ask(get("/mapobjects/ignored")).body);
  EXPECT_EQ(all->ignored_items.size(), 11U);
}

TEST(missions_pages, a_next_that_is_not_known_any_more_is_400) {
  judged_service service;
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(1, 20)));
  const auto old = page_of(service, "?limit=10").next.value();
  EXPECT_EQ(page_of(service, "?limit=10&next=" + old).map_objects.size(), 10U);
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, objects(5, 30)));
  for (const auto& next : {old, std::string("nonsense"), std::string("0-0-999999"), std::string(1025, '1')})
    EXPECT_EQ(service.ask(get("/mapobjects?next=" + next)).status, 400U) << next;
}

TEST(missions_pages, a_page_has_no_more_bytes_than_a_vehicle_takes) {
  judged_service service;
  auto wide = objects(1, 2000);
  for (auto& each : wide)
    each.class_group = std::string(64, '"') + std::string(900, 'x'); // longer than any schema allows
  ASSERT_TRUE(service_operations::set_map_objects(service.file(), mission_id, wide));
  const auto row = find_mission(service.file(), mission_id).value();
  const auto made = page(service.file(), row, page_kind::map_objects, {{}, 2000, {}});
  const auto& body = made->body;
  EXPECT_LE(body.size(), mission::max_page_bytes);
  EXPECT_NE(body.find("\"next\":\"" + made->next + "\""), std::string::npos);
}

} // namespace pages_test

} // namespace godwit::sim::missions
