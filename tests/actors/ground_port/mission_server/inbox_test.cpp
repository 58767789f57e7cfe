#include "actors/ground_port/mission_server/inbox.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
namespace inbox_test {

using godwit::tests::ms;

letter request(std::uint16_t seq) {
  io::mavlink::mission_request_int message;
  message.seq = seq;
  return {{255, 190}, message};
}

int seq_of(const letter& each) { return std::get<io::mavlink::mission_request_int>(each.what).seq; }

TEST(inbox, without_turns_gives_everything_at_once_in_order) {
  inbox mail(0);
  mail.put(request(1), 5 * ms);
  mail.put(request(2), 5 * ms);
  EXPECT_EQ(seq_of(*mail.take(5 * ms)), 1);
  EXPECT_EQ(seq_of(*mail.take(5 * ms)), 2);
  EXPECT_FALSE(mail.take(5 * ms).has_value());
}

TEST(inbox, gives_one_message_in_each_turn) {
  inbox mail(20 * ms);
  mail.put(request(1), 5 * ms);
  mail.put(request(2), 6 * ms);
  EXPECT_EQ(mail.next_turn_ns(), 20 * ms);
  EXPECT_FALSE(mail.take(19 * ms).has_value());
  EXPECT_EQ(seq_of(*mail.take(20 * ms)), 1);
  EXPECT_FALSE(mail.take(20 * ms).has_value());
  EXPECT_EQ(seq_of(*mail.take(40 * ms)), 2);
}

TEST(inbox, turns_come_whether_or_not_anything_waits) {
  inbox mail(20 * ms);
  mail.put(request(1), 5 * ms);
  (void)mail.take(20 * ms);
  mail.put(request(2), 90 * ms);
  EXPECT_EQ(mail.next_turn_ns(), 100 * ms);
}

TEST(inbox, two_messages_never_share_a_turn) {
  inbox mail(20 * ms);
  mail.put(request(1), 5 * ms);
  (void)mail.take(20 * ms);
  mail.put(request(2), 20 * ms);
  EXPECT_EQ(mail.next_turn_ns(), 40 * ms);
}

TEST(inbox, drops_and_counts_what_has_no_room) {
  inbox mail(20 * ms);
  for (std::size_t i = 0; i < max_waiting_messages + 10; ++i)
    mail.put(request(static_cast<std::uint16_t>(i)), ms);
  EXPECT_EQ(mail.dropped(), 10U);
  EXPECT_EQ(seq_of(*mail.take(20 * ms)), 0) << "the newest are dropped";
}

} // namespace inbox_test
} // namespace godwit::ground_port::mission_server
