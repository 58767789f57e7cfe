#include "io/mavlink/waypoint_file/waypoint_writer.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::io::mavlink {
namespace waypoint_writer_test {

std::vector<mission_item_int> one(void (*change)(mission_item_int&)) {
  mission_item_int item{.frame = 3, .command = 16, .autocontinue = 1, .x = 500'000'000, .y = 364'000'000, .z = 800};
  change(item);
  return {item};
}

waypoint_error error_of(const std::vector<mission_item_int>& items) {
  const auto written = write_waypoints(items);
  return written ? waypoint_error{} : written.error();
}

TEST(waypoint_writer, lines_have_tabs_and_as_many_digits_as_it_takes) {
  const auto text = write_waypoints(one([](mission_item_int& item) {
    item.current = 1;
    item.param1 = 0.1F;
    item.param4 = std::numeric_limits<float>::quiet_NaN();
  }));
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "QGC WPL 110\n0\t1\t3\t16\t0.1\t0\t0\tNaN\t50.0000000\t36.4000000\t800\t1\n");
}

TEST(waypoint_writer, a_plan_of_none_is_the_header) { EXPECT_EQ(write_waypoints({}), "QGC WPL 110\n"); }

TEST(waypoint_writer, what_no_reader_would_take_is_refused_with_its_place) {
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.seq = 4; })).message(),
            "line 2, index: seq 4 where 0 was expected");
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.frame = 13; })).code, waypoint_errc::unknown_frame);
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.x = 900'000'001; })).column, "x/lat");
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.y = -1'800'000'001; })).column, "y/lon");
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.current = 2; })).column, "current");
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.autocontinue = 9; })).column, "autocontinue");
  EXPECT_EQ(error_of(one([](mission_item_int& item) { item.z = std::numeric_limits<float>::infinity(); })).column,
            "z/alt");
  EXPECT_EQ(error_of(std::vector<mission_item_int>(max_waypoint_items + 1)).code, waypoint_errc::too_large);
}

rc::Gen<float> any_param() {
  return rc::gen::map(rc::gen::arbitrary<std::uint32_t>(), [](std::uint32_t bits) {
    const auto value = std::bit_cast<float>(bits);
    return std::isinf(value) ? std::numeric_limits<float>::quiet_NaN() : value;
  });
}

rc::Gen<mission_item_int> any_item() {
  return rc::gen::exec([] {
    constexpr std::array<std::uint8_t, 15> frames{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 21};
    mission_item_int item;
    item.frame = *rc::gen::elementOf(frames);
    item.command = *rc::gen::arbitrary<std::uint16_t>();
    item.current = *rc::gen::inRange<std::uint8_t>(0, 2);
    item.autocontinue = *rc::gen::inRange<std::uint8_t>(0, 2);
    for (const auto param : {&mission_item_int::param1, &mission_item_int::param2, &mission_item_int::param3,
                             &mission_item_int::param4, &mission_item_int::z})
      item.*param = *any_param();
    // Half of what fits into 32 bits is no place on earth.
    item.x = *rc::gen::inRange<std::int32_t>(-900'000'000, 900'000'001);
    item.y = *rc::gen::inRange<std::int32_t>(-1'800'000'000, 1'800'000'001);
    return item;
  });
}

bool same(const mission_item_int& a, const mission_item_int& b) {
  const auto same_float = [&](float mission_item_int::*member) {
    return std::bit_cast<std::uint32_t>(a.*member) == std::bit_cast<std::uint32_t>(b.*member) ||
           (std::isnan(a.*member) && std::isnan(b.*member));
  };
  return a.seq == b.seq && a.frame == b.frame && a.command == b.command && a.current == b.current &&
         a.autocontinue == b.autocontinue && a.x == b.x && a.y == b.y && a.mission_type == b.mission_type &&
         same_float(&mission_item_int::param1) && same_float(&mission_item_int::param2) &&
         same_float(&mission_item_int::param3) && same_float(&mission_item_int::param4) &&
         same_float(&mission_item_int::z);
}

RC_GTEST_PROP(waypoint_writer, every_plan_reads_back_as_itself, ()) {
  auto items = *rc::gen::container<std::vector<mission_item_int>>(any_item());
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i].seq = static_cast<std::uint16_t>(i);
  const auto text = write_waypoints(items);
  RC_ASSERT(text.has_value());
  const auto read = read_waypoints(*text);
  RC_ASSERT(read.has_value());
  RC_ASSERT(read->size() == items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    RC_ASSERT(same(read->at(i), items[i]));
}

} // namespace waypoint_writer_test
} // namespace godwit::io::mavlink
