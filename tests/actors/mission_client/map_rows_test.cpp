#include "actors/mission_client/outbox/map_rows.hpp"

#include <gtest/gtest.h>

namespace map_rows_test {

using namespace godwit;
using namespace godwit::mission_client;

TEST(mission_client_map_rows, every_kind_of_observation_has_its_name_at_the_service) {
  mapobjects_store::batch rows;
  for (const auto& [kind, name] : enum_names(mapobjects_store::observation_kind{})) {
    rows.observations = {{"o", "m", "x", kind, "vehicle", {1, 2, {}}, 0, 0.5}};
    const auto sent = observations_of(rows).observations.at(0);
    EXPECT_EQ(io::name_of(sent.kind), name);
    EXPECT_EQ(sent.object_id.has_value(), kind != mapobjects_store::observation_kind::found);
  }
}

TEST(mission_client_map_rows, a_page_becomes_rows_of_the_map) {
  mission::map_object_page page;
  page.map_objects.push_back({"o", "vehicle", 47.4, 8.5, 441.5, 0.8, "2026-05-01T08:00:00Z", "2026-05-03T16:20:00.5Z"});
  const auto rows = objects_of(page, "m");
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->at(0).mission_id, "m");
  EXPECT_EQ(rows->at(0).position.altitude_m, 441.5);
  EXPECT_EQ(rows->at(0).last_seen_ns % 1'000'000'000, 500'000'000);
  mission::ignored_item_page ignored;
  ignored.ignored_items.push_back({"i", "32TMT6634049690", "vehicle", "2026-05-04T10:16:02Z"});
  EXPECT_EQ(ignored_items_of(ignored, "m")->at(0).mgrs_cell, "32TMT6634049690");
}

TEST(mission_client_map_rows, a_time_that_is_none_is_an_error) {
  mission::map_object_page page;
  page.map_objects.push_back({"o", "vehicle", 1, 2, {}, 0.8, "yesterday", "2026-05-03T16:20:00Z"});
  EXPECT_FALSE(objects_of(page, "m"));
  mission::ignored_item_page ignored;
  ignored.ignored_items.push_back({"i", "c", "vehicle", ""});
  EXPECT_FALSE(ignored_items_of(ignored, "m"));
}

} // namespace map_rows_test
