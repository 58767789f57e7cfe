#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_file.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::io::mavlink {

namespace waypoint_file_test {

namespace fs = std::filesystem;

class waypoint_file : public testing::Test {
protected:
  waypoint_file() {
    std::string pattern = (fs::temp_directory_path() / "godwit-plan-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~waypoint_file() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

private:
  fs::path folder_;
};

const std::vector<mission_item_int> plan{
    {.seq = 0, .frame = 3, .command = 22, .autocontinue = 1, .x = 473'977'418, .y = 85'455'939, .z = 30},
    {.seq = 1, .frame = 2, .command = 20, .autocontinue = 1}};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST_F(waypoint_file, what_is_saved_is_loaded) {
  ASSERT_TRUE(save_waypoint_file(at("plan"), plan));
  const auto loaded = load_waypoint_file(at("plan"), mav_mission_type::fence);
  ASSERT_TRUE(loaded) << loaded.error().message();
  ASSERT_EQ(loaded->size(), 2U);
  EXPECT_EQ(loaded->at(0).x, 473'977'418);
  EXPECT_EQ(loaded->at(1).mission_type, 1);
  EXPECT_EQ(files(), 1U);
}

TEST_F(waypoint_file, a_fence_of_places_alone_is_loaded_as_a_fence_and_as_nothing_else) {
  std::ofstream(at("fence.txt")) << "1 1\n0 0\n0 2\n2 2\n0 0\n";
  const auto loaded = load_waypoint_file(at("fence.txt"), mav_mission_type::fence);
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_EQ(loaded->size(), 4U);
  EXPECT_EQ(load_waypoint_file(at("fence.txt")).error().message(), at("fence.txt").string() + ": it holds a fence");
  std::ofstream(at("rally.txt")) << "RALLY 1 1 20 0 0 0\n";
  EXPECT_EQ(load_waypoint_file(at("rally.txt"), mav_mission_type::rally)->size(), 1U);
  EXPECT_EQ(load_waypoint_file(at("rally.txt"), mav_mission_type::fence).error().message(),
            at("rally.txt").string() + ": it holds rally points");
}

TEST_F(waypoint_file, an_error_names_the_file) {
  std::ofstream(at("plan")) << "QGC WPL 110\nwhatever\n";
  EXPECT_EQ(load_waypoint_file(at("plan")).error().message(),
            at("plan").string() + ": line 2: 1 column; an item has 12, parted by tabs or spaces");
}

TEST_F(waypoint_file, what_can_not_be_read_is_told_in_words) {
  const auto missing = load_waypoint_file(at("missing"));
  EXPECT_EQ(missing.error().code, waypoint_errc::io);
  EXPECT_EQ(missing.error().message(), at("missing").string() + ": No such file or directory");
  EXPECT_NE(load_waypoint_file(at(".")).error().message().find("a folder"), std::string::npos);
}

TEST_F(waypoint_file, a_file_without_an_end_is_not_read_to_its_end) {
  EXPECT_EQ(load_waypoint_file("/dev/zero").error().code, waypoint_errc::too_large);
}

TEST_F(waypoint_file, a_plan_that_can_not_be_saved_leaves_the_older_one) {
  ASSERT_TRUE(save_waypoint_file(at("plan"), plan));
  const auto before = text_of(at("plan"));
  EXPECT_EQ(save_waypoint_file(at("plan"), std::vector{plan[1]}).error().code, waypoint_errc::wrong_sequence);
  EXPECT_EQ(text_of(at("plan")), before);
  EXPECT_EQ(save_waypoint_file("/dev/full", plan).error().code, waypoint_errc::io);
  EXPECT_EQ(save_waypoint_file(at("no") / "plan", plan).error().code, waypoint_errc::io);
  fs::create_directory(at("folder"));
  EXPECT_EQ(save_waypoint_file(at("folder"), plan).error().code, waypoint_errc::io);
  EXPECT_EQ(files(), 2U) << "nothing is left behind";
}

} // namespace waypoint_file_test

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
