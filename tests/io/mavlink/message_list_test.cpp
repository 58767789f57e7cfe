#include <gtest/gtest.h>

#include "io/mavlink/message_list.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace message_list_test {

using two = message_list<heartbeat, statustext>;

TEST(message_list, visits_the_type_of_the_frame) {
  const auto frame = encode(heartbeat{.type = 2}, {1, 1}, 0);
  int type = 0;
  EXPECT_TRUE(two::visit(frame.view(), [&]<message M>(const M& each) {
    if constexpr (std::is_same_v<M, heartbeat>)
      type = each.type;
  }));
  EXPECT_EQ(type, 2);
}

TEST(message_list, does_not_visit_other_ids) {
  int calls = 0;
  const auto count = [&](const auto&) { ++calls; };
  EXPECT_FALSE(two::visit(encode(ping{}, {1, 1}, 0).view(), count));                       // a gap
  EXPECT_FALSE(two::visit(encode(protocol_version{}, {1, 1}, 0).view(), count));           // above the last
  EXPECT_FALSE(two::visit(frame_buffer(0xFFFFFF, 0, {}, {1, 1}, 0, false).view(), count)); // the highest there is
  EXPECT_EQ(calls, 0);
}

TEST(message_list, says_what_it_contains) {
  static_assert(two::contains(0) && two::contains(253));
  static_assert(!two::contains(1) && !two::contains(254) && !two::contains(1U << 23U));
  EXPECT_EQ(two::place_of(253), 1);
}

} // namespace message_list_test
} // namespace godwit::io::mavlink
