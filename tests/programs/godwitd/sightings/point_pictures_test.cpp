#include "programs/godwitd/sightings/point_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/programs/godwitd/scratch.hpp"

namespace point_pictures_test {

using namespace godwit;
using daemon::point_pictures;

constexpr const char* mission = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

io::eyes::cutout picture(std::size_t bytes = 1) {
  return {1, 100, 48, 48, std::vector<std::byte>(bytes, std::byte{0xFF})};
}

class point_pictures_test : public testing::Test {
protected:
  // A sighting with a picture of BYTES becomes a part of POINT.
  static void show(point_pictures& all, const std::string& sighting, std::uint64_t point, std::int64_t at_ns,
                   std::size_t bytes = 1) {
    all.add(sighting, picture(bytes));
    all.belongs(sighting, {point, mission, at_ns});
  }
  [[nodiscard]] std::size_t files(const std::string& ending) const {
    std::error_code failed;
    const std::filesystem::directory_iterator all(folder, failed);
    return static_cast<std::size_t>(
        std::count_if(begin(all), end(all), [&](const auto& each) { return each.path().extension() == ending; }));
  }

  test::scratch scratch;
  std::filesystem::path folder = scratch.file("pictures");
};

TEST_F(point_pictures_test, a_point_has_the_newest_picture_of_its_sightings) {
  point_pictures all(folder);
  EXPECT_FALSE(all.of(1));
  for (const auto* each : {"a", "b", "c"})
    all.add(each, picture());
  EXPECT_FALSE(all.of(1)) << "nobody knows yet of which point it is";
  all.belongs("a", {1, mission, 100});
  all.belongs("b", {1, mission, 300});
  all.belongs("c", {1, mission, 200});
  all.belongs("of a file, without a picture", {1, mission, 400});
  ASSERT_TRUE(all.of(1));
  EXPECT_EQ(all.of(1)->captured_ns, 300);
  EXPECT_EQ(all.of(1)->jpeg.size(), 1U);
  EXPECT_FALSE(all.of(2));
  EXPECT_EQ(all.points(), std::vector<std::uint64_t>{1}) << "of others nobody needs to ask";
  EXPECT_EQ(files(".jpg"), 1U) << "a newer one takes the place of one that is new";
}

TEST_F(point_pictures_test, they_survive_the_process_and_so_does_what_is_to_be_delivered) {
  {
    point_pictures all(folder);
    show(all, "a", 1, 100, 7);
    show(all, "b", 2, 200);
    ASSERT_TRUE(all.next());
    all.noted(all.next()->file);
  }
  const point_pictures again(folder);
  ASSERT_TRUE(again.of(1));
  EXPECT_EQ(again.of(1)->jpeg.size(), 7U);
  EXPECT_EQ(again.points(), (std::vector<std::uint64_t>{1, 2}));
  const auto next = again.next();
  ASSERT_TRUE(next);
  EXPECT_EQ(next->mission_id, mission);
  EXPECT_EQ(next->observation_id, "b");
  EXPECT_EQ(next->captured_ns, 200);
  EXPECT_TRUE(std::filesystem::exists(folder / next->file));
}

TEST_F(point_pictures_test, one_that_was_noted_stays_until_it_is_delivered_also_after_a_newer_one) {
  point_pictures all(folder);
  show(all, "a", 1, 100);
  const auto first = all.next()->file;
  all.noted(first);
  EXPECT_FALSE(all.next());
  show(all, "b", 1, 200);
  EXPECT_TRUE(std::filesystem::exists(folder / first));
  EXPECT_EQ(all.of(1)->captured_ns, 200);
  EXPECT_EQ(all.next()->observation_id, "b");
}

TEST_F(point_pictures_test, of_sightings_that_wait_and_of_files_the_oldest_go_and_what_nobody_has_noted_is_counted) {
  point_pictures all(folder);
  for (std::size_t n = 0; n <= point_pictures::max_waiting; ++n)
    all.add(std::to_string(n), picture());
  all.belongs("0", {1, mission, 1});
  all.belongs("1", {2, mission, 2});
  EXPECT_FALSE(all.of(1));
  EXPECT_TRUE(all.of(2));
  for (std::uint64_t point = 3; point <= point_pictures::max_files + 2; ++point)
    show(all, "more", point, static_cast<std::int64_t>(point));
  EXPECT_FALSE(all.of(2));
  EXPECT_TRUE(all.of(3));
  EXPECT_EQ(all.lost(), 1U);
  EXPECT_EQ(files(".jpg"), point_pictures::max_files);
  EXPECT_EQ(files(".new"), point_pictures::max_files);
}

TEST_F(point_pictures_test, a_disk_that_takes_none_is_a_picture_less_and_counted) {
  std::ofstream(folder.string()) << "no folder";
  point_pictures all(folder);
  show(all, "a", 1, 100);
  EXPECT_FALSE(all.of(1));
  EXPECT_EQ(all.lost(), 1U);
}

TEST_F(point_pictures_test, what_else_is_in_the_folder_is_left_alone) {
  std::filesystem::create_directories(folder);
  for (const auto* each : {"notes.txt", "x_1_m_s.jpg", "1_m_s.jpg", "100_1_m_s.jpg.part"})
    std::ofstream(folder / each) << "x";
  const point_pictures all(folder);
  EXPECT_TRUE(all.points().empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "notes.txt"));
}

} // namespace point_pictures_test
