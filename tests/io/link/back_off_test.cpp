#include "io/link/back_off.hpp"

#include <gtest/gtest.h>

namespace godwit::io::link {
namespace back_off_test {

using std::chrono::milliseconds;

TEST(link_back_off, each_wait_is_twice_the_last_one_up_to_the_cap) {
  back_off pause(milliseconds(100), milliseconds(1000));
  for (const int expected_ms : {100, 200, 400, 800, 1000, 1000})
    EXPECT_EQ(pause.next(), milliseconds(expected_ms));
}

TEST(link_back_off, it_starts_anew_when_told) {
  back_off pause(milliseconds(100), milliseconds(1000));
  static_cast<void>(pause.next());
  static_cast<void>(pause.next());
  pause.reset();
  EXPECT_EQ(pause.next(), milliseconds(100));
}

} // namespace back_off_test
} // namespace godwit::io::link
