#include "io/eyes/channel.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

namespace channel_test {

using namespace godwit::io::eyes;

struct both_ends {
  std::pair<channel, channel> ends = make_channel_pair().value();
  channel& daemon = ends.first;
  channel& helper = ends.second;
};

TEST(eyes_channel, what_is_sent_comes_in_order_and_then_nothing) {
  both_ends s;
  EXPECT_EQ(s.daemon.send(want_picture{1, 100}), send_result::sent);
  EXPECT_EQ(s.daemon.send(want_picture{2, 100}), send_result::sent);
  for (const std::int64_t until : {1, 2}) {
    const auto read = s.helper.receive();
    ASSERT_TRUE(read && read->said);
    EXPECT_EQ(std::get<want_picture>(*read->said).until_ns, until);
  }
  const auto none = s.helper.receive();
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->said);
  EXPECT_FALSE(none->is_closed);
}

TEST(eyes_channel, nobody_waits_for_a_reader_that_does_not_read) {
  both_ends s;
  auto how = send_result::sent;
  for (int i = 0; i < 100'000 && how == send_result::sent; ++i)
    how = s.daemon.send(pose{});
  EXPECT_EQ(how, send_result::no_room);
}

TEST(eyes_channel, an_end_that_is_gone_is_told_by_both_reading_and_sending) {
  auto pair = std::make_unique<both_ends>();
  channel left = std::move(pair->ends.first);
  pair.reset();
  const auto read = left.receive();
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->is_closed);
  EXPECT_EQ(left.send(pose{}), send_result::closed);
}

TEST(eyes_channel, garbage_is_an_error_and_what_comes_after_it_is_read) {
  both_ends s;
  const std::string garbage(70'000, 'x');
  ASSERT_GT(::send(s.helper.number(), "rubbish and more", 16, 0), 0);
  ASSERT_GT(::send(s.helper.number(), garbage.data(), garbage.size(), 0), 0);
  ASSERT_EQ(s.helper.send(status{}), send_result::sent);
  EXPECT_EQ(s.daemon.receive().error().code, decode_errc::no_message);
  EXPECT_EQ(s.daemon.receive().error().code, decode_errc::too_long);
  const auto read = s.daemon.receive();
  ASSERT_TRUE(read && read->said);
  EXPECT_TRUE(std::holds_alternative<status>(*read->said));
}

} // namespace channel_test
