#include "io/mavlink/signing/channel.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/position.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::io::mavlink {
namespace channel_test {

using godwit::tests::ms;
constexpr std::int64_t wall_ns = 1'800'000'000'000 * ms; // 2027
constexpr sender us{1, 191};
constexpr sender vehicle{1, 1};

instant at(std::int64_t ns) { return {ns, wall_ns + ns}; }

signing_settings with_key(unsigned_policy policy = {}) {
  std::array<std::byte, secret_key_size> bytes{};
  bytes.fill(std::byte{7});
  return {.key = std::make_shared<secret_key>(bytes), .link = link_id{1}, .unsigned_frames = policy};
}

// The senders of the frames that are believed.
std::vector<sender> heard(channel& by, byte_view bytes, link::peer_id peer = 1, bool is_datagram = true,
                          std::int64_t now_ns = 0) {
  std::vector<sender> result;
  by.unpack(peer, is_datagram, bytes, at(now_ns), [&](const frame_view& each) { result.push_back(each.from()); });
  return result;
}

TEST(channel, each_component_that_we_speak_as_counts_its_own_frames) {
  channel c({}, {});
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(c.pack(heartbeat{}, us, 0)->view().sequence(), i);
    EXPECT_EQ(c.pack(heartbeat{}, vehicle, 0)->view().sequence(), i);
  }
  EXPECT_EQ(c.next_sequence(us), 3);
  EXPECT_EQ(c.next_sequence({9, 9}), 0);
  EXPECT_EQ(c.report({}).frames_out, 6U);
}

TEST(channel, speakers_are_bounded) {
  channel c({}, {});
  for (std::uint8_t i = 0; i <= max_numbered_speakers; ++i)
    (void)c.pack(heartbeat{}, {i, 1}, 0);
  EXPECT_EQ(c.next_sequence({0, 1}), 0) << "the first made room";
  EXPECT_EQ(c.next_sequence({1, 1}), 1);
}

TEST(channel, a_sequence_number_wraps_around) {
  channel c({}, {});
  for (int i = 0; i < 256; ++i)
    (void)c.pack(heartbeat{}, us, 0);
  EXPECT_EQ(c.next_sequence(us), 0);
}

TEST(channel, without_a_key_frames_are_neither_signed_nor_asked_to_be) {
  channel c({}, {});
  EXPECT_FALSE(c.is_signing());
  const auto frame = c.pack(heartbeat{}, us, wall_ns);
  EXPECT_FALSE(frame->view().is_signed());
  EXPECT_EQ(heard(c, frame->span()), std::vector<sender>{us});
}

TEST(channel, frames_that_are_split_over_datagrams_are_joined_for_each_peer_by_itself) {
  channel c({}, {});
  const auto mine = encode(heartbeat{}, vehicle, 0);
  const auto yours = encode(heartbeat{}, {2, 1}, 0);
  EXPECT_TRUE(heard(c, mine.span().first(9), 1).empty());
  EXPECT_TRUE(heard(c, yours.span().first(13), 2).empty());
  EXPECT_EQ(heard(c, mine.span().subspan(9), 1), std::vector<sender>{vehicle});
  EXPECT_EQ(heard(c, yours.span().subspan(13), 2), (std::vector<sender>{{2, 1}}));
  EXPECT_EQ(c.report({}).parse_errors_total, 0U);
}

TEST(channel, what_a_peer_has_left_unfinished_is_let_go_as_that_peers) {
  channel c({}, {});
  const auto good = encode(heartbeat{}, {2, 1}, 0);
  std::vector<std::byte> claims{std::byte{0xfd}, std::byte{255}, std::byte{0}, std::byte{0}};
  claims.insert(claims.end(), 6, std::byte{0}); // HEARTBEAT of 255 bytes, which do not come
  claims.insert(claims.end(), good.span().begin(), good.span().end());
  EXPECT_TRUE(heard(c, claims, 7).empty());
  std::vector<link::peer_id> peers;
  c.on_silence(at(stream_silence_ms * ms), [&](link::peer_id peer, const frame_view&) { peers.push_back(peer); });
  EXPECT_EQ(peers, std::vector<link::peer_id>{7});
}

TEST(channel, with_a_key_only_signed_frames_are_believed) {
  channel ours(with_key(), {});
  channel theirs(with_key(), {});
  EXPECT_TRUE(heard(ours, encode(heartbeat{}, vehicle, 0).span()).empty());
  EXPECT_EQ(ours.rejected(), 1U);
  EXPECT_FALSE(ours.last_rejection().empty());
  const auto frame = theirs.pack(heartbeat{}, vehicle, wall_ns);
  EXPECT_EQ(heard(ours, frame->span()), std::vector<sender>{vehicle});
  EXPECT_TRUE(heard(ours, frame->span()).empty()) << "a replay";
  EXPECT_EQ(ours.frames_in(), 1U);
}

TEST(channel, unsigned_frames_are_believed_where_the_policy_says_so) {
  channel ours(with_key(unsigned_policy::accept_all()), {});
  EXPECT_EQ(heard(ours, encode(heartbeat{}, vehicle, 0).span()).size(), 1U);
}

TEST(channel, what_two_peers_send_does_not_mix) {
  channel c({}, {});
  const auto frame = encode(attitude{.roll = 1, .yawspeed = 2}, vehicle, 0);
  const auto half = frame.size() / 2;
  EXPECT_TRUE(heard(c, frame.span().first(half), 1, false).empty());
  EXPECT_TRUE(heard(c, frame.span().first(half), 2, false).empty());
  EXPECT_EQ(heard(c, frame.span().subspan(half), 1, false).size(), 1U);
  EXPECT_EQ(heard(c, frame.span().subspan(half), 2, false).size(), 1U);
}

TEST(channel, a_frame_whose_rest_does_not_come_is_let_go_of_after_a_silence) {
  channel c({}, {});
  const auto frame = encode(attitude{.roll = 1, .yawspeed = 2}, vehicle, 0);
  EXPECT_TRUE(heard(c, frame.span().first(9), 1, false, 0).empty());
  c.on_silence(at(stream_silence_ms * ms), [](link::peer_id, const frame_view&) {});
  EXPECT_EQ(heard(c, frame.span(), 1, false, stream_silence_ms * ms).size(), 1U);
}

TEST(channel, more_peers_than_the_bound_push_out_the_one_that_was_silent_longest) {
  channel c({}, {});
  const auto frame = encode(heartbeat{}, vehicle, 0);
  std::vector<std::byte> damaged(frame.span().begin(), frame.span().end());
  damaged.back() ^= std::byte{1};
  for (std::size_t i = 0; i < 2 * max_scanned_peers; ++i)
    (void)heard(c, damaged, static_cast<link::peer_id>(i + 1), true, static_cast<std::int64_t>(i));
  EXPECT_EQ(c.report({}).parse_errors_total, 2 * max_scanned_peers) << "what was counted of them stays counted";
}

TEST(channel, gaps_are_counted_for_the_sender_that_is_followed) {
  channel c({}, {});
  (void)heard(c, encode(heartbeat{}, vehicle, 1).span());
  (void)heard(c, encode(heartbeat{}, vehicle, 5).span());
  EXPECT_EQ(c.report(vehicle).sequence_gaps, 3U);
  EXPECT_EQ(c.report(vehicle).last_sequence, 5);
  EXPECT_EQ(c.report(std::nullopt).sequence_gaps, 0U);
}

TEST(channel, frames_under_the_name_of_who_is_followed_from_elsewhere_are_no_gaps) {
  channel c({}, {});
  for (int i = 0; i < 100; ++i) {
    (void)heard(c, encode(heartbeat{}, vehicle, static_cast<std::uint8_t>(i)).span(), 1);
    (void)heard(c, encode(heartbeat{}, vehicle, static_cast<std::uint8_t>(77 * i)).span(), 2);
  }
  EXPECT_EQ(c.report(vehicle, 1).sequence_gaps, 0U);
  EXPECT_EQ(c.report(vehicle, 1).followed_in, 100U);
  EXPECT_GT(c.report(vehicle).sequence_gaps, 0U);
}

TEST(channel, frames_that_are_refused_for_their_signature_are_no_gaps_also_from_the_same_address) {
  channel c(with_key(), {});
  channel other(with_key(), {});
  for (int i = 0; i < 100; ++i) {
    (void)heard(c, other.pack(heartbeat{}, vehicle, wall_ns + i)->span());
    (void)heard(c, encode(heartbeat{}, vehicle, static_cast<std::uint8_t>(77 * i)).span());
  }
  EXPECT_EQ(c.report(vehicle).signing_rejected, 100U);
  EXPECT_EQ(c.report(vehicle).sequence_gaps, 0U);
  EXPECT_EQ(c.report(vehicle).followed_in, 100U);
}

} // namespace channel_test
} // namespace godwit::io::mavlink
