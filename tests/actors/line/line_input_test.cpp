#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "actors/line/line_input.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages.hpp"

namespace line_input_test {

using namespace godwit;
using line::line_input;

TEST(line_input, bytes_and_states_come_back_as_they_were) {
  io::link::arrival came{3, true, {}};
  for (unsigned n = 0; n < 256; ++n)
    came.bytes.push_back(std::byte{static_cast<unsigned char>(n)});
  const auto bytes = std::get<io::link::arrival>(line_input::of(came).news());
  EXPECT_EQ(bytes.peer, 3U);
  EXPECT_TRUE(bytes.is_datagram);
  EXPECT_EQ(bytes.bytes, came.bytes);
  const io::link::link_status down{io::link::link_phase::down, "the cable", 7};
  EXPECT_EQ(std::get<io::link::link_status>(line_input::of(down).news()), down);
}

} // namespace line_input_test

namespace secret_eraser_test {

using namespace godwit;
using namespace io::mavlink;
using line::secret_eraser;
using bytes = std::vector<std::byte>;

constexpr sender station{255, 190};

setup_signing with_key() {
  setup_signing result;
  result.secret_key.fill(0xA5);
  result.initial_timestamp = 77;
  return result;
}

template <class M>
bytes frame_of(const M& message) {
  const auto frame = encode(message, station, 1);
  return {frame.span().begin(), frame.span().end()};
}

bytes signed_heartbeat() {
  const heartbeat beat{};
  auto result = frame_of(beat);
  result[incompat_at] = std::byte{incompat_signed};
  result.insert(result.end(), signature_size, std::byte{0xB6});
  return result;
}

void append(bytes& to, const bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

bool has(const bytes& all, int value) {
  return std::ranges::find(all, std::byte{static_cast<unsigned char>(value)}) != all.end();
}

// ALL in pieces of SIZE.
bytes erased(bytes all, std::size_t size) {
  secret_eraser eraser;
  for (std::size_t at = 0; at < all.size(); at += size)
    eraser.erase(1, false, std::span(all).subspan(at, std::min(size, all.size() - at)));
  return all;
}

TEST(secret_eraser, a_key_that_is_split_over_datagrams_is_taken_out_also_when_others_speak_in_between) {
  const auto key = frame_of(with_key());
  const auto other = frame_of(heartbeat{});
  for (std::size_t cut = header_size; cut < key.size(); ++cut) {
    secret_eraser eraser;
    auto first = key;
    auto second = first;
    first.resize(cut);
    second.erase(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(cut));
    eraser.erase(1, true, first);
    auto in_between = other;
    eraser.erase(2, true, in_between);
    EXPECT_EQ(in_between, other);
    eraser.erase(1, true, second);
    EXPECT_FALSE(has(first, 0xA5) || has(second, 0xA5)) << cut;
    auto later = other;
    eraser.erase(1, true, later);
    EXPECT_EQ(later, other) << "and nothing else";
  }
}

TEST(secret_eraser, a_key_is_taken_out_wherever_a_stream_is_cut) {
  auto all = frame_of(heartbeat{});
  const auto before = all;
  append(all, frame_of(with_key()));
  append(all, before);
  for (std::size_t size = 1; size <= all.size(); ++size) {
    const auto left = erased(all, size);
    EXPECT_FALSE(has(left, 0xA5)) << size;
    EXPECT_TRUE(std::equal(before.begin(), before.end(), left.begin())) << size;
    EXPECT_TRUE(std::equal(before.rbegin(), before.rend(), left.rbegin())) << size;
  }
}

TEST(secret_eraser, a_key_is_found_after_bytes_that_are_no_frame) {
  bytes all{std::byte{0xFD}, std::byte{200}, std::byte{0}}; // as if a long frame began
  append(all, frame_of(with_key()));
  EXPECT_FALSE(has(erased(all, all.size()), 0xA5));
}

TEST(secret_eraser, signatures_are_taken_out_and_nothing_else_is_touched) {
  auto all = signed_heartbeat();
  append(all, frame_of(heartbeat{}));
  for (std::size_t size = 1; size <= all.size(); ++size) {
    const auto left = erased(all, size);
    EXPECT_FALSE(has(left, 0xB6)) << size;
    for (std::size_t at = 0; at < all.size(); ++at)
      EXPECT_TRUE(left[at] == all[at] || all[at] == std::byte{0xB6}) << size << ", " << at;
  }
}

TEST(secret_eraser, a_datagram_begins_anew) {
  secret_eraser eraser;
  auto torn = signed_heartbeat();
  torn.resize(header_size + 2);
  eraser.erase(1, true, torn);
  auto whole = signed_heartbeat();
  eraser.erase(1, true, whole);
  EXPECT_FALSE(has(whole, 0xB6));
}

} // namespace secret_eraser_test
