#include "io/mavlink/waypoint_file/waypoint_file.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

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
} // namespace godwit::io::mavlink
