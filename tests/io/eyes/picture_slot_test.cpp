#include "io/eyes/picture_slot.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

namespace picture_slot_test {

using namespace godwit::io;
using namespace godwit::io::eyes;

picture_slot other_side_of(const picture_slot& slot) {
  return picture_slot::attach(link::descriptor(::fcntl(slot.number(), F_DUPFD_CLOEXEC, 0))).value();
}

std::vector<std::byte> filled(std::size_t size, int value) { return {size, static_cast<std::byte>(value)}; }

TEST(eyes_picture_slot, the_newest_picture_wins_and_each_is_read_once) {
  const auto ours = picture_slot::make().value();
  auto theirs = other_side_of(ours);
  EXPECT_FALSE(ours.read());
  EXPECT_TRUE(theirs.publish(filled(10, 1), 100, 64, 48));
  EXPECT_TRUE(theirs.publish(filled(20, 2), 200, 640, 480));
  const auto seen = ours.read();
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->number, 2U);
  EXPECT_EQ(seen->captured_ns, 200);
  EXPECT_EQ(seen->width_px, 640);
  EXPECT_EQ(seen->jpeg, filled(20, 2));
  EXPECT_FALSE(ours.read(seen->number));
}

TEST(eyes_picture_slot, one_that_is_too_large_is_refused_and_the_one_before_stays) {
  const auto ours = picture_slot::make().value();
  auto theirs = other_side_of(ours);
  EXPECT_TRUE(theirs.publish(filled(10, 1), 100, 64, 48));
  EXPECT_FALSE(theirs.publish(filled(max_picture_bytes + 1, 2), 200, 64, 48));
  EXPECT_EQ(ours.read()->captured_ns, 100);
}

TEST(eyes_picture_slot, a_writer_that_begins_anew_goes_on_counting) {
  const auto ours = picture_slot::make().value();
  (void)other_side_of(ours).publish(filled(10, 1), 100, 64, 48);
  (void)other_side_of(ours).publish(filled(10, 2), 200, 64, 48);
  EXPECT_EQ(ours.read(1)->number, 2U);
}

TEST(eyes_picture_slot, nobody_can_make_the_memory_shorter) {
  const auto ours = picture_slot::make().value();
  EXPECT_NE(::ftruncate(ours.number(), 0), 0);
}

TEST(eyes_picture_slot, a_descriptor_of_something_else_is_refused) {
  EXPECT_FALSE(picture_slot::attach(link::descriptor(::memfd_create("small", MFD_CLOEXEC))));
  EXPECT_FALSE(picture_slot::attach(link::descriptor(-1)));
}

TEST(eyes_picture_slot, a_reader_never_sees_half_of_a_picture) {
  const auto ours = picture_slot::make().value();
  auto theirs = other_side_of(ours);
  std::atomic<bool> is_over{false};
  std::thread writer([&] {
    for (int i = 1; i <= 20'000; ++i)
      (void)theirs.publish(filled(2'000 + static_cast<std::size_t>(i % 7), i % 251), i, 64, 48);
    is_over = true;
  });
  while (!is_over)
    if (const auto seen = ours.read()) {
      EXPECT_EQ(seen->jpeg.size(), 2'000 + static_cast<std::size_t>(seen->captured_ns % 7));
      EXPECT_TRUE(std::ranges::all_of(
          seen->jpeg, [&](std::byte each) { return each == static_cast<std::byte>(seen->captured_ns % 251); }));
    }
  writer.join();
  EXPECT_EQ(ours.read()->number, 20'000U);
}

TEST(eyes_picture_slot, each_track_has_its_newest_cut_out) {
  const auto ours = picture_slot::make().value();
  auto theirs = other_side_of(ours);
  EXPECT_FALSE(ours.read_cutout(0)) << "nothing was written";
  EXPECT_TRUE(theirs.publish_cutout(7, filled(10, 1), 100, 48, 32));
  EXPECT_TRUE(theirs.publish_cutout(7, filled(12, 2), 200, 50, 34));
  EXPECT_TRUE(theirs.publish_cutout(8, filled(14, 3), 300, 52, 36));
  const auto seen = ours.read_cutout(7);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->captured_ns, 200);
  EXPECT_EQ(seen->width_px, 50);
  EXPECT_EQ(seen->jpeg, filled(12, 2));
  EXPECT_EQ(ours.read_cutout(8)->jpeg, filled(14, 3));
  EXPECT_FALSE(ours.read_cutout(9));
}

TEST(eyes_picture_slot, a_cut_out_is_never_that_of_another_track_and_never_too_large) {
  auto ours = picture_slot::make().value();
  auto theirs = other_side_of(ours);
  EXPECT_TRUE(theirs.publish_cutout(7, filled(10, 1), 100, 48, 32));
  EXPECT_TRUE(theirs.publish_cutout(7 + max_cutouts, filled(10, 2), 200, 48, 32)) << "the same place";
  EXPECT_FALSE(ours.read_cutout(7));
  EXPECT_TRUE(ours.read_cutout(7 + max_cutouts));
  EXPECT_FALSE(theirs.publish_cutout(1, filled(max_cutout_bytes + 1, 1), 100, 48, 32));
  EXPECT_FALSE(theirs.publish_cutout(1, filled(10, 1), 0, 48, 32)) << "0 is none";
  ours.clear();
  EXPECT_FALSE(ours.read_cutout(7 + max_cutouts));
}

} // namespace picture_slot_test
