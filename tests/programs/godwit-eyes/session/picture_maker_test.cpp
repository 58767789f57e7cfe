#include "programs/godwit-eyes/session/picture_maker.hpp"

#include <gtest/gtest.h>

#include "tests/io/video/painted_frame.hpp"
#include "tests/support/time_units.hpp"

namespace cutout_maker_test {

using namespace godwit;
using godwit::eyes::cutout_maker;

using godwit::tests::s;

io::eyes::candidates seen_at(std::int64_t captured_ns, const std::vector<io::eyes::box>& boxes) {
  io::eyes::candidates result;
  result.captured_ns = captured_ns;
  for (const auto& each : boxes) {
    io::eyes::candidate one;
    one.track = static_cast<std::uint32_t>(result.seen.size()) + 1;
    one.where = each;
    result.seen.push_back(one);
  }
  return result;
}

struct maker {
  void add(std::int64_t captured_ns, const std::vector<io::eyes::box>& boxes, int width = 641, int height = 361) {
    cutouts.add(seen_at(captured_ns, boxes), io::video::painted_frame(width, height, 90, captured_ns));
  }
  io::eyes::picture_slot slot = io::eyes::picture_slot::make().value();
  cutout_maker cutouts{slot};
};

TEST(cutout_maker, a_candidate_is_cut_out_with_as_much_again_around_it) {
  maker m;
  m.add(s, {{100, 80, 60, 40}});
  const auto made = m.slot.read_cutout(1);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->captured_ns, s);
  EXPECT_EQ(made->width_px, 120);
  EXPECT_EQ(made->height_px, 80);
  EXPECT_EQ(made->jpeg.at(0), std::byte{0xFF});
  EXPECT_EQ(made->jpeg.at(1), std::byte{0xD8});
}

TEST(cutout_maker, small_ones_have_more_around_them_and_large_ones_are_reduced_in_their_shape) {
  maker m;
  m.add(s, {{100, 80, 6, 4}, {100, 80, 200, 100}});
  EXPECT_EQ(m.slot.read_cutout(1)->width_px, cutout_maker::least_side_px);
  EXPECT_EQ(m.slot.read_cutout(2)->width_px, cutout_maker::most_side_px);
  EXPECT_EQ(m.slot.read_cutout(2)->height_px, cutout_maker::most_side_px / 2);
}

TEST(cutout_maker, at_the_edge_there_is_less_of_it_and_outside_none) {
  maker m;
  m.add(s, {{-20, -20, 60, 40}, {630, 350, 60, 40}, {-500, 100, 20, 20}, {100, 3000, 20, 20}});
  EXPECT_EQ(m.slot.read_cutout(1)->width_px, 70);
  EXPECT_GT(m.slot.read_cutout(2)->width_px, 0);
  EXPECT_FALSE(m.slot.read_cutout(3));
  EXPECT_FALSE(m.slot.read_cutout(4));
}

TEST(cutout_maker, of_each_track_there_is_one_a_second_and_of_a_picture_a_few) {
  maker m;
  const std::vector<io::eyes::box> many(cutout_maker::most_a_picture + 1, {100, 80, 20, 20});
  const auto last = static_cast<std::uint32_t>(many.size());
  m.add(s, many);
  EXPECT_EQ(m.slot.read_cutout(1)->captured_ns, s);
  EXPECT_FALSE(m.slot.read_cutout(last));
  m.add(s + 1, many);
  EXPECT_EQ(m.slot.read_cutout(1)->captured_ns, s);
  EXPECT_EQ(m.slot.read_cutout(last)->captured_ns, s + 1) << "its turn";
  m.add(2 * s, many);
  EXPECT_EQ(m.slot.read_cutout(1)->captured_ns, 2 * s);
}

} // namespace cutout_maker_test
