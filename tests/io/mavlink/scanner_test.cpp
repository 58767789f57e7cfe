#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include <rapidcheck/gtest.h>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/scanner.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace scanner_test {

const auto ignore = [](const frame_view&) {};

byte_buffer frame_bytes(const frame_buffer& frame) { return {frame.span().begin(), frame.span().end()}; }

// A frame with an id that is in no message set.
byte_buffer unknown_frame(std::size_t length, std::uint8_t sequence = 0) {
  return frame_bytes(frame_buffer(0xABCDEF, 0, byte_buffer(length, std::byte{7}), {1, 1}, sequence, false));
}

byte_buffer v1_frame(std::string_view without_crc, std::uint8_t crc_extra) {
  auto bytes = from_hex(without_crc);
  const auto crc = frame_crc(byte_view(bytes).subspan(1), crc_extra);
  bytes.push_back(static_cast<std::byte>(crc & 0xFFU));
  bytes.push_back(static_cast<std::byte>(crc >> 8U));
  return bytes;
}

byte_buffer v1_heartbeat() { return v1_frame("fe0900010100000000000203040303", heartbeat::crc_extra); }

byte_buffer joined(std::initializer_list<byte_buffer> parts) {
  byte_buffer result;
  for (const auto& each : parts)
    append(result, each);
  return result;
}

const byte_buffer good = from_hex("fd09000000ffbe000000000000001208000403211a");

TEST(scanner, hands_a_frame_on_where_it_lies) {
  const auto bytes = joined({good, good});
  scanner frames;
  std::vector<const std::byte*> at;
  frames.feed(bytes, [&](const frame_view& frame) { at.push_back(frame.bytes().data()); });
  EXPECT_EQ(at, (std::vector<const std::byte*>{bytes.data(), bytes.data() + good.size()}));
  EXPECT_EQ(frames.waiting_bytes(), 0U);
}

TEST(scanner, counts_by_kind) {
  auto damaged = good;
  damaged[12] ^= std::byte{1};
  scanner frames;
  frames.feed_datagram(joined({good, damaged, good}), ignore);
  EXPECT_EQ(frames.counters().frames, 2U);
  EXPECT_EQ(frames.counters().bad_crc, 1U);
  EXPECT_EQ(frames.counters().of(0).received, 2U);
  EXPECT_EQ(frames.counters().of(0).bad_crc, 1U);
  EXPECT_EQ(frames.counters().of(0xABCDEF).received, 0U);
  EXPECT_EQ(frames.counters().bytes, 3 * good.size());
  EXPECT_EQ(frames.counters().garbage_bytes, good.size());
}

TEST(scanner, discards_a_frame_with_an_unknown_flag_as_a_whole) {
  for (const bool with_signature : {false, true}) {
    auto flagged = with_signature ? from_hex("fd03010001ffbe000000fd00ff") : from_hex("fd03000001ffbe000000fd00ff");
    flagged[incompat_at] |= std::byte{0x02};
    const auto crc = frame_crc(byte_view(flagged).subspan(1), heartbeat::crc_extra);
    flagged.push_back(static_cast<std::byte>(crc & 0xFFU));
    flagged.push_back(static_cast<std::byte>(crc >> 8U));
    if (with_signature)
      append(flagged, byte_buffer(signature_size));
    scanner frames;
    frames.feed_datagram(joined({good, flagged, good}), ignore);
    EXPECT_EQ(frames.counters().frames, 2U);
    EXPECT_EQ(frames.counters().unknown_flag, 1U);
    EXPECT_EQ(frames.counters().garbage_bytes, 0U);
  }
}

TEST(scanner, takes_no_offence_at_unknown_compatibility_flags) {
  auto flagged = frame_bytes(encode(heartbeat{}, {1, 1}, 0));
  flagged[compat_at] = std::byte{0xFF};
  const auto crc = frame_crc(byte_view(flagged).subspan(1, flagged.size() - 3), heartbeat::crc_extra);
  flagged[flagged.size() - 2] = static_cast<std::byte>(crc & 0xFFU);
  flagged[flagged.size() - 1] = static_cast<std::byte>(crc >> 8U);
  EXPECT_EQ(frames_in(flagged).size(), 1U);
}

TEST(scanner, passes_over_an_unknown_id_when_what_looks_like_a_frame_or_the_end_follows) {
  scanner frames;
  frames.feed_datagram(joined({good, unknown_frame(40, 1), good, v1_heartbeat(), unknown_frame(7, 2)}), ignore);
  EXPECT_EQ(frames.counters().frames, 2U);
  EXPECT_EQ(frames.counters().unknown_id, 2U);
  EXPECT_EQ(frames.counters().garbage_bytes, 0U);
}

TEST(scanner, does_not_trust_the_length_of_an_unknown_id_when_anything_else_follows) {
  scanner frames;
  frames.feed_datagram(joined({unknown_frame(40), from_hex("55"), good}), ignore);
  EXPECT_EQ(frames.counters().frames, 1U);
  EXPECT_EQ(frames.counters().unknown_id, 0U);
}

TEST(scanner, does_not_trust_the_length_of_an_unknown_id_with_an_unknown_flag) {
  auto flagged = unknown_frame(40);
  flagged[incompat_at] = std::byte{0x02};
  scanner frames;
  frames.feed_datagram(joined({good, flagged, good}), ignore);
  EXPECT_EQ(frames.counters().frames, 2U);
  EXPECT_EQ(frames.counters().unknown_id, 0U);
  EXPECT_EQ(frames.counters().garbage_bytes, flagged.size());
}

TEST(scanner, a_frame_of_an_unknown_id_has_its_place_in_the_sequence_of_its_sender) {
  scanner frames;
  const auto of_vehicle = [](std::uint8_t sequence) { return frame_bytes(encode(heartbeat{}, {1, 1}, sequence)); };
  frames.feed_datagram(joined({of_vehicle(0), unknown_frame(40, 1), of_vehicle(2)}), ignore);
  EXPECT_EQ(frames.senders().all().front().lost, 0U);
}

TEST(scanner, does_not_pass_over_a_good_frame_inside_an_unknown_id) {
  // A false start whose length ends by chance where a frame begins.
  const auto start = from_hex("fd1d000000000000abcd"); // claims 41 bytes in all, the next frame and ten of its own
  EXPECT_EQ(frames_in(joined({start, good, from_hex("00000000000000000000"), good})).size(), 2U);
}

TEST(scanner, passes_over_mavlink_1_only_when_it_is_verified) {
  scanner frames;
  frames.feed_datagram(joined({v1_heartbeat(), good, v1_heartbeat()}), ignore);
  EXPECT_EQ(frames.counters().frames, 1U);
  EXPECT_EQ(frames.counters().v1_frames, 2U);
  EXPECT_EQ(frames.counters().garbage_bytes, 0U);
  EXPECT_EQ(frames_in(joined({from_hex("fe40"), good, from_hex("fe09000101"), good})).size(), 2U);
}

TEST(scanner, takes_a_mavlink_1_frame_with_and_without_extensions_but_of_no_other_length) {
  scanner frames;
  frames.feed_datagram(v1_frame("fe02000101290101", mission_set_current::crc_extra), ignore);          // of 4
  frames.feed_datagram(v1_frame("fe060001012b010100000000", mission_request_list::crc_extra), ignore); // of 2 or 3
  EXPECT_EQ(frames.counters().v1_frames, 0U);
  frames.feed_datagram(v1_frame("fe020001012b0101", mission_request_list::crc_extra), ignore);
  frames.feed_datagram(v1_frame("fe030001012b010100", mission_request_list::crc_extra), ignore);
  EXPECT_EQ(frames.counters().v1_frames, 2U);
}

TEST(scanner, lets_go_at_the_edge_of_a_datagram_and_counts_what_was_cut_off) {
  scanner frames;
  frames.feed_datagram(byte_view(good).first(15), ignore);
  EXPECT_EQ(frames.counters().cut_off, 1U);
  EXPECT_EQ(frames.waiting_bytes(), 0U);
  frames.feed_datagram(good, ignore);
  EXPECT_EQ(frames.counters().frames, 1U);
  frames.feed_datagram(from_hex("fdff0000"), ignore);
  frames.feed_datagram(joined({from_hex("fdff0000"), good}), ignore);
  EXPECT_EQ(frames.counters().frames, 2U);
  EXPECT_EQ(frames.counters().cut_off, 3U);
}

TEST(scanner, frames_that_are_split_over_datagrams_of_one_sender_are_joined_whatever_the_size_of_the_pieces) {
  std::vector<std::byte> all;
  for (int i = 0; i < 160; ++i)
    all.insert(all.end(), good.begin(), good.end());
  for (std::size_t size = 1; size <= 2 * good.size() + 1; ++size) {
    scanner frames;
    for (std::size_t at = 0; at < all.size(); at += size)
      frames.feed_next_datagram(byte_view(all).subspan(at, std::min(size, all.size() - at)), ignore);
    EXPECT_EQ(frames.counters().frames, 160U) << size;
    EXPECT_EQ(frames.counters().cut_off, 0U) << size;
  }
}

TEST(scanner, a_datagram_that_begins_with_a_frame_waits_for_no_rest_of_the_one_before) {
  for (std::size_t cut = 1; cut < good.size(); ++cut) {
    scanner frames;
    frames.feed_next_datagram(byte_view(good).first(cut), ignore);
    frames.feed_next_datagram(good, ignore);
    EXPECT_EQ(frames.counters().frames, 1U) << "at once, cut after " << cut;
    EXPECT_EQ(frames.waiting_bytes(), 0U);
    EXPECT_EQ(frames.counters().cut_off, 1U);
  }
}

TEST(scanner, where_the_joined_bytes_have_no_right_checksum_the_frames_in_them_are_found) {
  scanner frames;
  const auto half = byte_view(good).first(good.size() / 2);
  const auto rest = byte_view(good).subspan(good.size() / 2);
  frames.feed_next_datagram(half, ignore); // the datagram after it is lost
  for (int i = 0; i < 30; ++i)
    frames.feed_next_datagram(
        joined({byte_buffer(rest.begin(), rest.end()), good, byte_buffer(half.begin(), half.end())}), ignore);
  EXPECT_GE(frames.counters().frames, 58U);
}

TEST(scanner, waits_for_the_rest_of_a_stream) {
  scanner frames;
  for (const std::byte each : good)
    frames.feed({&each, 1}, ignore);
  EXPECT_EQ(frames.counters().frames, 1U);
  EXPECT_EQ(frames.waiting_bytes(), 0U);
}

TEST(scanner, counts_the_gaps_of_each_sender) {
  scanner frames;
  for (const int sequence : {1, 2, 5})
    frames.feed(encode(heartbeat{}, {1, 1}, static_cast<std::uint8_t>(sequence)).span(), ignore);
  EXPECT_EQ(frames.senders().all().front().lost, 2U);
}

// ---- 4,000 frames, a false start before each
// -------------------------------------------------------------------------

using false_start = byte_buffer (*)(std::mt19937_64&);

byte_buffer long_v2(std::mt19937_64&) { return from_hex("fdff0000"); }
byte_buffer long_v1(std::mt19937_64&) { return from_hex("fe40"); }
byte_buffer cut_off(std::mt19937_64& random) {
  auto frame = some_frames(1, random).front();
  frame.resize(1 + random() % (frame.size() - 2)); // without all its checksum: a next FD might be the byte it lacks
  return frame;
}
byte_buffer random_bytes(std::mt19937_64& random) {
  byte_buffer bytes(1 + random() % 40);
  for (auto& each : bytes)
    each = static_cast<std::byte>(random());
  return bytes;
}

// How many of 4,000 frames come out. PIECE(random) is the size of the next piece; 0 stands for a datagram for each
// frame.
std::size_t decoded_of_4000(false_start before, std::size_t (*piece)(std::mt19937_64&), std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto sent = some_frames(4000, random);
  std::size_t next = 0; // frames come in order, so each that comes is one of those not yet seen
  std::size_t decoded = 0;
  const auto sink = [&](const frame_view& frame) {
    for (auto i = next; i < sent.size(); ++i)
      if (std::ranges::equal(sent[i], frame.bytes())) {
        next = i + 1;
        ++decoded;
        return;
      }
  };
  scanner frames;
  byte_buffer stream;
  for (const auto& each : sent) {
    const auto with_start = joined({before(random), each});
    if (piece == nullptr)
      frames.feed_datagram(with_start, sink);
    else
      append(stream, with_start);
  }
  for (std::size_t at = 0; at < stream.size();) {
    const auto size = std::min(piece(random), stream.size() - at);
    frames.feed(byte_view(stream).subspan(at, size), sink);
    at += size;
  }
  frames.end_of_datagram(sink);
  return decoded;
}

std::size_t at_once(std::mt19937_64&) { return SIZE_MAX; }
std::size_t byte_by_byte(std::mt19937_64&) { return 1; }
std::size_t any_size(std::mt19937_64& random) { return 1 + random() % 600; }

constexpr auto ways_to_feed = {&at_once, &byte_by_byte, &any_size, static_cast<decltype(&at_once)>(nullptr)};

TEST(scanner, loses_no_frame_to_a_false_start_before_each_of_4000) {
  const auto seed = std::random_device{}();
  for (const auto piece : ways_to_feed) {
    EXPECT_EQ(decoded_of_4000(long_v2, piece, seed), 4000U) << "seed " << seed;
    EXPECT_EQ(decoded_of_4000(long_v1, piece, seed), 4000U) << "seed " << seed;
  }
}

TEST(scanner, loses_no_frame_to_a_frame_cut_off_before_each_of_4000) {
  // A frame cut off and what fills it up have the right checksum by chance, one time in 65,536: so not any seed.
  for (const std::uint64_t seed : {1, 2, 3})
    for (const auto piece : ways_to_feed)
      EXPECT_EQ(decoded_of_4000(cut_off, piece, seed), 4000U) << "seed " << seed;
  const auto seed = std::random_device{}();
  for (const auto piece : ways_to_feed)
    EXPECT_GE(decoded_of_4000(cut_off, piece, seed), 3995U) << "seed " << seed;
}

TEST(scanner, loses_hardly_a_frame_to_random_bytes_before_each_of_4000) {
  const auto seed = std::random_device{}();
  for (const auto piece : ways_to_feed)
    EXPECT_GE(decoded_of_4000(random_bytes, piece, seed), 3990U) << "seed " << seed;
}

// ---- floods
// ----------------------------------------------------------------------------------------------------------

constexpr std::size_t most_waiting = max_frame_size + header_size - 1;

TEST(scanner, memory_is_constant) {
  // What needs no destructor owns nothing outside of itself.
  static_assert(std::is_trivially_destructible_v<scanner> && std::is_trivially_copyable_v<scanner>);
  static_assert(sizeof(scanner) <= 8192);
}

TEST(scanner, hours_of_half_frames_and_garbage_keep_no_more_than_a_frame_and_lose_no_good_one) {
  const auto seed = std::random_device{}();
  std::mt19937_64 random(seed);
  scanner frames;
  std::size_t most = 0;
  constexpr std::size_t rounds = 36'000; // ten a second for an hour
  for (std::size_t i = 0; i < rounds; ++i) {
    frames.feed_datagram(cut_off(random), ignore);
    frames.feed(byte_view(good).first(1 + random() % (good.size() - 1)), ignore);
    most = std::max(most, frames.waiting_bytes());
    frames.end_of_datagram(ignore);
    frames.feed_datagram(good, ignore);
  }
  EXPECT_GE(frames.counters().of(0).received, rounds) << "seed " << seed;
  EXPECT_LE(most, most_waiting);
}

TEST(scanner, a_stream_of_nothing_but_false_starts_keeps_no_more_than_a_frame) {
  scanner frames;
  std::size_t most = 0;
  for (int i = 0; i < 20'000; ++i) {
    frames.feed(from_hex("fdff000000"), ignore);
    most = std::max(most, frames.waiting_bytes());
  }
  EXPECT_LE(most, most_waiting);
  frames.end_of_datagram(ignore);
  EXPECT_EQ(frames.counters().garbage_bytes, 100'000U);
}

// ---- pieces
// ----------------------------------------------------------------------------------------------------------

byte_buffer any_part(std::mt19937_64& random) {
  switch (random() % 8) {
  case 0:
    return long_v2(random);
  case 1:
    return long_v1(random);
  case 2:
    return cut_off(random);
  case 3:
    return random_bytes(random);
  case 4:
    return unknown_frame(random() % 256);
  case 5:
    return v1_heartbeat();
  default:
    return some_frames(1, random).front();
  }
}

struct seen {
  std::vector<byte_buffer> frames;
  scan_counters counters;
};

template <class Size>
seen scan(byte_view bytes, Size next_size) {
  seen result;
  scanner frames;
  const auto sink = [&](const frame_view& frame) {
    result.frames.emplace_back(frame.bytes().begin(), frame.bytes().end());
  };
  while (!bytes.empty()) {
    const auto size = std::min<std::size_t>(next_size(), bytes.size());
    frames.feed(bytes.first(size), sink);
    bytes = bytes.subspan(size);
  }
  frames.end_of_datagram(sink);
  result.counters = frames.counters();
  return result;
}

RC_GTEST_PROP(scanner_property, finds_the_same_in_any_pieces, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto parts = *rc::gen::inRange(0, 60);
  byte_buffer bytes;
  for (int i = 0; i < parts; ++i)
    append(bytes, any_part(random));
  const auto largest = *rc::gen::inRange<std::size_t>(1, 700);
  const auto whole = scan(bytes, [&] { return bytes.size(); });
  const auto pieces = scan(bytes, [&] { return 1 + random() % largest; });
  RC_ASSERT(pieces.frames == whole.frames);
  RC_ASSERT(pieces.counters.bad_crc == whole.counters.bad_crc);
  RC_ASSERT(pieces.counters.unknown_id == whole.counters.unknown_id);
  RC_ASSERT(pieces.counters.v1_frames == whole.counters.v1_frames);
  RC_ASSERT(pieces.counters.garbage_bytes == whole.counters.garbage_bytes);
  RC_ASSERT(pieces.counters.cut_off == whole.counters.cut_off);
}

} // namespace scanner_test
} // namespace godwit::io::mavlink
