#include "messages/mission/item_fields.hpp"

#include <array>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {
namespace item_fields_test {

document small_mission() {
  document result;
  result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  result.items = {takeoff{"up", 40}, waypoint{"w", {47.5, 8.5, 40}, 0, 2, {}}, return_home{"home"}};
  return result;
}

TEST(item_fields, an_item_is_written_with_its_kind_and_without_what_is_absent) {
  std::string text;
  append_json_value(text, item(waypoint{"w", {47.5, 8.5, 40}, 0, 2, {}}));
  EXPECT_EQ(text, R"({"kind":"waypoint","id":"w","at":{"latitude":47.5,"longitude":8.5,"altitude_m":40},)"
                  R"("hold_s":0,"accept_radius_m":2})");
}

TEST(item_fields, a_struct_with_items_goes_through_the_journal_as_any_other) {
  const auto mission = small_mission();
  document again;
  const auto read = io::read_json(nlohmann::json::parse(io::to_json(mission)), again);
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_TRUE(io::equal(again, mission));
}

TEST(item_fields, an_unknown_kind_names_its_place) {
  document out;
  const auto read = io::read_json({{"items", {{{"id", "a"}, {"kind", "hover"}}}}}, out);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().message(), "items[0].kind: expected a kind of item, found \"hover\"");
}

TEST(item_fields, the_trace_shows_an_item_as_its_json) {
  std::array<std::byte, 4096> room{};
  io::byte_sink sink(room);
  io::encode_value(sink, small_mission());
  ASSERT_FALSE(sink.overflow());
  io::byte_source source(std::span<const std::byte>(room).first(sink.used()));
  std::string text;
  io::append_decoded_json<document>(text, source);
  EXPECT_EQ(nlohmann::json::parse(text), nlohmann::json::parse(io::to_json(small_mission())));
}

TEST(item_fields, a_trace_that_was_cut_off_still_gives_json) {
  std::array<std::byte, 4096> room{};
  io::byte_sink sink(room);
  io::encode_value(sink, small_mission());
  for (std::size_t size = 0; size < sink.used(); ++size) {
    io::byte_source source(std::span<const std::byte>(room).first(size));
    std::string text;
    io::append_decoded_json<document>(text, source);
    EXPECT_FALSE(nlohmann::json::parse(text, nullptr, false).is_discarded()) << size << ": " << text;
  }
}

TEST(item_fields, the_schema_of_the_trace_knows_that_an_item_is_an_object) {
  EXPECT_EQ(io::json_schema<document>()["properties"]["items"]["items"]["type"], "object");
}

} // namespace item_fields_test
} // namespace godwit::mission
