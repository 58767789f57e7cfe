#include "io/eyes/codec.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace eyes_codec_test {

using namespace godwit::io::eyes;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

decode_errc error_of(const std::string& datagram) {
  const auto read = decode(bytes_of(datagram));
  EXPECT_FALSE(read);
  return read ? decode_errc{} : read.error().code;
}

std::string framed(std::uint8_t kind, const std::string& body) {
  std::string result{'g', 'e', static_cast<char>(protocol_version), static_cast<char>(kind)};
  for (unsigned shift = 0; shift < 32; shift += 8)
    result += static_cast<char>((body.size() >> shift) & 0xFFU);
  return result + body;
}

candidates two_movers() {
  candidates said;
  said.captured_ns = 5;
  candidate with_place;
  with_place.track = 7;
  with_place.where = {1, 2, 3, 4};
  with_place.place = ground_place{47.4, 8.5, 4, 5, -1, 1.8};
  with_place.confidence = 0.75;
  with_place.looks_like = object_class::animal;
  said.seen = {with_place, candidate{}};
  return said;
}

TEST(eyes_codec, each_message_comes_back_as_it_was) {
  begin first;
  first.uri = "rtsp://127.0.0.1:8554/camera";
  first.focal_px = 900.5;
  status now;
  now.source = source_state::failed;
  now.reason = "nobody answers";
  now.fault = picture_fault::black;
  pose where;
  where.w = 0.5;
  for (const message& each :
       {message(first), message(where), message(want_picture{5, 100}), message(now), message(two_movers())}) {
    const auto read = decode(bytes_of(encode(each)));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(encode(*read), encode(each));
  }
}

TEST(eyes_codec, what_is_no_message_is_refused_with_the_reason) {
  const auto good = encode(status{});
  EXPECT_EQ(error_of(""), decode_errc::too_short);
  EXPECT_EQ(error_of(good.substr(0, head_bytes - 1)), decode_errc::too_short);
  EXPECT_EQ(error_of(std::string(max_datagram_bytes + 1, 'g')), decode_errc::too_long);
  EXPECT_EQ(error_of("xx" + good.substr(2)), decode_errc::no_message);
  EXPECT_EQ(error_of(good + " "), decode_errc::wrong_length);
  EXPECT_EQ(error_of(framed(99, "{}")), decode_errc::unknown_kind);
  EXPECT_EQ(error_of(framed(3, "{")), decode_errc::unreadable);
  EXPECT_EQ(error_of(framed(3, R"({"unknown":1})")), decode_errc::unreadable);
  EXPECT_EQ(error_of(framed(3, R"({"frames":"many"})")), decode_errc::unreadable);
  auto other_version = good;
  other_version[2] = 2;
  EXPECT_EQ(error_of(other_version), decode_errc::wrong_version);
}

TEST(eyes_codec, values_that_can_not_be_are_refused) {
  candidates said = two_movers();
  said.seen[0].place->latitude_deg = 91;
  EXPECT_EQ(error_of(encode(said)), decode_errc::impossible);
  said = two_movers();
  said.seen[1].confidence = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(encode(said)), decode_errc::impossible);
  said.seen.assign(max_candidates + 1, candidate{});
  EXPECT_EQ(error_of(encode(said)), decode_errc::impossible);
  status long_winded;
  long_winded.reason = std::string(max_text_bytes + 1, 'x');
  EXPECT_EQ(error_of(encode(long_winded)), decode_errc::impossible);
}

TEST(eyes_codec, all_that_a_picture_may_hold_fits_into_a_datagram) {
  candidates said;
  said.captured_ns = std::numeric_limits<std::int64_t>::max();
  candidate longest = two_movers().seen[0];
  longest.where = {1.0 / 3, 2.0 / 3, 1.0 / 7, 1.0 / 9};
  longest.place = ground_place{-47.123456789012345, -170.123456789012345, 1.0 / 3, 1.0 / 7, -1.0 / 9, 1.0 / 11};
  said.seen.assign(max_candidates, longest);
  EXPECT_LE(encode(said).size(), max_datagram_bytes);
}

TEST(eyes_codec, a_text_is_cut_between_characters) {
  const auto cut = clipped(std::string(max_text_bytes - 1, 'x') + "\u00E4\u00E4");
  EXPECT_EQ(cut, std::string(max_text_bytes - 1, 'x'));
  EXPECT_EQ(clipped("short"), "short");
}

RC_GTEST_PROP(eyes_codec_property, bytes_that_were_changed_are_an_error_or_another_sound_message, ()) {
  auto bytes = encode(*rc::gen::elementOf(std::vector<message>{status{}, two_movers(), pose{}, begin{}}));
  const auto changes = *rc::gen::inRange(1, 8);
  for (int i = 0; i < changes; ++i)
    bytes[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(bytes.size())))] = *rc::gen::arbitrary<char>();
  if (const auto read = decode(bytes_of(bytes)))
    RC_ASSERT(problem_of(*read).empty());
}

} // namespace eyes_codec_test
