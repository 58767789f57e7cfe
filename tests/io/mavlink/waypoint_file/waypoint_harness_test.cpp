// The fuzzer's rules find what they are there for.
#include "tests/fuzz/waypoint_harness.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace godwit::io::mavlink::fuzz {
namespace waypoint_harness_test {

const std::string plan = "QGC WPL 110\n0 1 3 16 0 5 0 0 50.0000001 36.4 800 1\n";

template <auto member, int value>
struct reads_wrongly : real_waypoints {
  static auto read(std::string_view text) {
    auto items = read_waypoints(text);
    if (items)
      for (auto& each : *items)
        each.*member = value;
    return items;
  }
};

struct writes_a_little_off : real_waypoints {
  static auto write(std::span<const mission_item_int> items) {
    std::vector<mission_item_int> moved(items.begin(), items.end());
    for (auto& each : moved)
      ++each.x;
    return write_waypoints(moved);
  }
};

struct refuses_without_words : real_waypoints {
  static waypoint_result<std::vector<mission_item_int>> read(std::string_view) {
    return tl::make_unexpected(waypoint_error{});
  }
};

TEST(waypoint_harness, nothing_is_found_in_the_corpus) {
  std::size_t files = 0;
  for (const auto& each : std::filesystem::directory_iterator(std::string(GODWIT_TEST_DATA) + "/fuzz/waypoint_file")) {
    std::ostringstream text;
    text << std::ifstream(each.path(), std::ios::binary).rdbuf();
    EXPECT_EQ(check_waypoints(text.str()), std::nullopt) << each.path();
    ++files;
  }
  EXPECT_GE(files, 5U);
}

TEST(waypoint_harness, planted_defects_are_found) {
  EXPECT_EQ(check_waypoints(plan), std::nullopt);
  EXPECT_NE((check_waypoints<reads_wrongly<&mission_item_int::seq, 1>>(plan)), std::nullopt);
  EXPECT_NE((check_waypoints<reads_wrongly<&mission_item_int::frame, 99>>(plan)), std::nullopt);
  EXPECT_NE((check_waypoints<reads_wrongly<&mission_item_int::x, 900'000'001>>(plan)), std::nullopt);
  EXPECT_NE((check_waypoints<reads_wrongly<&mission_item_int::current, 7>>(plan)), std::nullopt);
  EXPECT_NE((check_waypoints<writes_a_little_off>(plan)), std::nullopt);
  EXPECT_NE((check_waypoints<refuses_without_words>(plan)), std::nullopt);
}

} // namespace waypoint_harness_test
} // namespace godwit::io::mavlink::fuzz
