#include "programs/godwit-eyes/look/look.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "io/video/jpeg_encoder.hpp"
#include "io/video/recorder.hpp"
#include "tests/support/eyes/generated_frame.hpp"
#include "tests/support/eyes/small_net.hpp"
#include "tests/support/eyes/suite.hpp"

namespace look_test {

using namespace godwit;
using namespace godwit::eyes;
namespace fs = std::filesystem;
using sim::camera::suite_case;

constexpr int pictures = 60;
constexpr std::int64_t frame_ns = 33'333'333;

// A flight over movers, as godwit-eyes records it; made once.
class look_through_recording : public testing::Test {
protected:
  static void SetUpTestSuite() {
    fs::remove_all(root());
    sim::camera::suite_options options;
    options.width = 640;
    options.height = 360;
    const suite_case flight(sim::camera::tuning_seed(6), sim::camera::tier::a, options);
    io::video::jpeg_encoder encoder(90);
    io::video::recorder to({root() + "/a recording with 100%", 100'000'000});
    for (int n = 0; n < pictures; ++n) {
      auto taken = flight.frame(n);
      if (n == 40) // a hand before the lens
        std::ranges::fill(taken.seen.grey, std::uint8_t{90});
      const auto frame = eyes::test::frame_of(std::move(taken.seen), (n + 1) * frame_ns);
      to.add(encoder.encode(frame).value(), frame.captured_ns, frame.width, frame.height);
    }
  }
  static void TearDownTestSuite() { fs::remove_all(root()); }

  static std::string root() { return fs::temp_directory_path() / ("godwit_look_" + std::to_string(::getpid())); }
  static io::video::camera_uri recording() {
    for (const auto& each : fs::directory_iterator(root() + "/a recording with 100%"))
      return io::video::recording_at(each.path().string());
    return {};
  }
  static std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> result;
    for (const auto& each : fs::directory_iterator(folder))
      result.push_back(each.path().filename().string());
    std::ranges::sort(result);
    return result;
  }
};

TEST_F(look_through_recording, each_picture_is_looked_at_at_its_time_in_the_recording) {
  look_settings wanted;
  wanted.from = recording();
  const auto seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_EQ(seen->pictures, static_cast<std::uint64_t>(pictures));
  EXPECT_EQ(seen->width, 640);
  EXPECT_NEAR(seen->end_s, (pictures - 1) / 30.0, 0.01);
  EXPECT_EQ(seen->ended_early, "");
  EXPECT_EQ(seen->drawn, 0);
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> result;
  for (std::string line; std::getline(file, line);)
    result.push_back(line);
  return result;
}

TEST_F(look_through_recording, boxes_and_use_of_each_picture_are_written_for_who_scores_them) {
  look_settings wanted;
  wanted.from = recording();
  wanted.boxes = root() + "/boxes.csv";
  wanted.use = root() + "/use.csv";
  const auto seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  const auto use = lines_of(wanted.use);
  ASSERT_EQ(use.size(), pictures + 1U);
  EXPECT_EQ(use[0], "frame,usable");
  EXPECT_EQ(use[1], "1,0");   // the first tells nothing
  EXPECT_EQ(use[41], "41,0"); // the hand before the lens
  EXPECT_EQ(static_cast<std::uint64_t>(
                std::ranges::count_if(use, [](const std::string& row) { return row.ends_with(",1"); })),
            seen->usable());
  const auto boxes = lines_of(wanted.boxes);
  int rows = 0;
  for (const auto& [number, track] : seen->tracks)
    rows += track.pictures;
  EXPECT_GT(rows, 0);
  ASSERT_EQ(boxes.size(), rows + 1U);
  EXPECT_EQ(boxes[0], "frame,track,x,y,w,h,score");
  for (const auto& row : boxes)
    EXPECT_EQ(std::ranges::count(row, ','), 6) << row;
}

TEST_F(look_through_recording, a_table_that_is_there_is_not_written_over) {
  look_settings wanted;
  wanted.from = recording();
  wanted.use = root() + "/kept.csv";
  std::ofstream(wanted.use) << "mine";
  const auto seen = look_through(wanted);
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.error(), wanted.use + " is there already: name another file, or delete it");
  EXPECT_EQ(lines_of(wanted.use).at(0), "mine");
}

TEST_F(look_through_recording, what_moves_and_why_pictures_are_of_no_use_is_said) {
  look_settings wanted;
  wanted.from = recording();
  const auto seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_GT(seen->tracks.size(), 2U);
  EXPECT_EQ(seen->reasons[static_cast<std::size_t>(unusable::blank)], 1U);
  EXPECT_GT(seen->usable(), 40U);
  EXPECT_EQ(std::accumulate(seen->reasons.begin(), seen->reasons.end(), std::uint64_t{0}), seen->pictures);
  const auto table = table_of(*seen);
  EXPECT_NE(table.find("pictures   60 of 640 x 360"), std::string::npos) << table;
  EXPECT_NE(table.find("1  blank: the picture has one brightness: a cap, or no signal"), std::string::npos) << table;
}

TEST_F(look_through_recording, a_model_says_what_things_look_like_and_one_that_is_none_is_refused) {
  look_settings wanted;
  wanted.from = recording();
  wanted.model = eyes::test::written(eyes::test::small_net(), root() + "/net");
  const auto seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_TRUE(std::ranges::any_of(seen->tracks,
                                  [](const auto& each) { return each.second.looks_like == object_class::person; }));
  EXPECT_NE(table_of(*seen).find("  person\n"), std::string::npos) << table_of(*seen);
  wanted.model = eyes::test::written(eyes::test::small_net(3), root() + "/other");
  const auto refused = look_through(wanted);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find("rows of 85 numbers"), std::string::npos) << refused.error();
}

TEST_F(look_through_recording, one_of_so_many_is_drawn_and_never_more_than_wished) {
  look_settings wanted;
  wanted.from = recording();
  wanted.folder = root() + "/drawn";
  wanted.every = 20;
  auto seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_EQ(seen->drawn, 3);
  EXPECT_EQ(files_in(wanted.folder),
            (std::vector<std::string>{"picture-000001.png", "picture-000021.png", "picture-000041.png"}));
  wanted.folder = root() + "/few";
  wanted.every = 1;
  wanted.most_drawn = 2;
  seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_EQ(files_in(wanted.folder).size(), 2U);
}

TEST_F(look_through_recording, a_part_of_it_can_be_chosen) {
  look_settings wanted;
  wanted.from = recording();
  wanted.begin_s = 0.5;
  wanted.seconds = 1;
  const auto seen = look_through(wanted);
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_NEAR(static_cast<double>(seen->pictures), 30, 1);
  EXPECT_GE(seen->begin_s, 0.5);
  EXPECT_LE(seen->end_s, 1.5);
}

TEST_F(look_through_recording, a_folder_with_something_in_it_is_left_as_it_is) {
  look_settings wanted;
  wanted.from = recording();
  wanted.folder = root() + "/full";
  fs::create_directories(wanted.folder);
  std::ofstream(wanted.folder + "/picture-000001.png") << "mine";
  const auto seen = look_through(wanted);
  ASSERT_FALSE(seen);
  EXPECT_NE(seen.error().find("is not empty"), std::string::npos) << seen.error();
  EXPECT_EQ(fs::file_size(wanted.folder + "/picture-000001.png"), 4U);
}

TEST_F(look_through_recording, what_is_no_recording_is_said) {
  look_settings wanted;
  wanted.from = io::video::recording_at(root() + "/nothing.mkv");
  auto seen = look_through(wanted);
  ASSERT_FALSE(seen);
  EXPECT_NE(seen.error().find("nothing.mkv can not be read: No such file"), std::string::npos) << seen.error();
  std::ofstream(root() + "/text.mkv") << "this is no film, and has never been one";
  wanted.from = io::video::recording_at(root() + "/text.mkv");
  seen = look_through(wanted);
  ASSERT_FALSE(seen);
  EXPECT_NE(seen.error(), "");
}

} // namespace look_test
