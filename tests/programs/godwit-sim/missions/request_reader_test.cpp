#include "programs/godwit-sim/missions/request_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {
namespace {

progress feed(request_reader& reader, std::string_view text) { return reader.feed(std::as_bytes(std::span(text))); }

std::string posted(const std::string& rest, const std::string& headers, const std::string& body) {
  return "POST " + target(rest) + " HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n" + headers + "\r\n" +
         body;
}

std::string with_length(const std::string& rest, const std::string& body) {
  return posted(rest, "Content-Length: " + std::to_string(body.size()) + "\r\n", body);
}

TEST(missions_request_reader, a_request_is_read_with_what_the_service_looks_at) {
  request_reader reader;
  const auto text = posted("/progress", "Authorization: Bearer x\r\nContent-Length: 2\r\n", "{}");
  ASSERT_EQ(feed(reader, text), progress::complete);
  EXPECT_TRUE(reader.can_be_kept());
  const auto got = reader.take();
  EXPECT_EQ(got.verb, "POST");
  EXPECT_EQ(got.target, target("/progress"));
  EXPECT_EQ(got.authorization, "Bearer x");
  EXPECT_EQ(got.content_type, "application/json");
  EXPECT_EQ(got.body, "{}");
}

TEST(missions_request_reader, requests_may_come_together_and_in_any_pieces) {
  const std::string chunked = posted("/progress", "Transfer-Encoding: chunked\r\n", "3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n");
  const std::string empty = posted("/progress", "Transfer-Encoding: chunked\r\n", "0\r\n\r\n");
  const std::string plain = with_length("/progress", "fgh");
  rc::check("in any pieces", [&](const std::vector<unsigned char>& sizes) {
    const std::string all = chunked + empty + plain;
    request_reader reader;
    std::string bodies;
    std::size_t at = 0;
    for (std::size_t i = 0; at < all.size(); ++i) {
      const std::size_t size = sizes.empty() ? 1 : std::max<std::size_t>(1, sizes[i % sizes.size()] % 40U);
      auto now = feed(reader, std::string_view(all).substr(at, size));
      at += size;
      while (now == progress::complete) {
        bodies += reader.take().body + "|";
        now = reader.next();
      }
      RC_ASSERT(now == progress::more);
    }
    RC_ASSERT(bodies == "abcde||fgh|");
  });
}

TEST(missions_request_reader, a_body_that_is_too_large_is_refused_before_it_is_read) {
  request_reader reader;
  const auto length = std::to_string(mission::max_answer_bytes + 1);
  ASSERT_EQ(feed(reader, posted("/waypoints", "Content-Length: " + length + "\r\n", "")), progress::refused);
  EXPECT_EQ(reader.refusal().status, 413U);
  EXPECT_FALSE(reader.can_be_kept());

  request_reader huge;
  ASSERT_EQ(feed(huge, posted("/tail", "Content-Length: 99999999999\r\n", "")), progress::refused);
  EXPECT_EQ(huge.refusal().status, 413U);

  request_reader chunked;
  auto now = feed(chunked, posted("/waypoints", "Transfer-Encoding: chunked\r\n", ""));
  const std::string piece = "1000\r\n" + std::string(4096, 'x') + "\r\n";
  for (int i = 0; i < 17 && now == progress::more; ++i)
    now = feed(chunked, piece);
  ASSERT_EQ(now, progress::refused);
  EXPECT_EQ(chunked.refusal().status, 413U);
}

TEST(missions_request_reader, a_head_that_is_too_long_is_refused) {
  for (const bool in_pieces : {false, true}) {
    request_reader reader;
    const std::string text = "GET / HTTP/1.1\r\nX: " + std::string(2 * max_request_head_bytes, 'x');
    auto now = progress::more;
    for (std::size_t at = 0; at < text.size() && now == progress::more; at += in_pieces ? 1000 : text.size())
      now = feed(reader, std::string_view(text).substr(at, in_pieces ? 1000 : text.size()));
    ASSERT_EQ(now, progress::refused);
    EXPECT_EQ(reader.refusal().status, 431U);
  }
}

TEST(missions_request_reader, what_is_no_http_is_refused) {
  for (const auto* text : {"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 hello of TLS\r\n\r\n", "HELO\r\n\r\n",
                           "GET / HTTP/3.7\r\n\r\n", "POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"}) {
    request_reader reader;
    ASSERT_EQ(feed(reader, text), progress::refused) << text;
    EXPECT_EQ(reader.refusal().status, 400U);
    EXPECT_EQ(reader.refusal().content_type, problem_type);
  }
}

TEST(missions_request_reader, who_waits_for_100_is_told_once_to_continue) {
  request_reader reader;
  ASSERT_EQ(feed(reader, posted("/progress", "Content-Length: 2\r\nExpect: 100-continue\r\n", "")), progress::more);
  EXPECT_TRUE(reader.take_continue());
  EXPECT_FALSE(reader.take_continue());
  EXPECT_EQ(feed(reader, "{}"), progress::complete);
}

TEST(missions_request_reader, a_connection_that_is_to_close_is_not_kept) {
  for (const auto* text : {"GET / HTTP/1.1\r\nConnection: close\r\n\r\n", "GET / HTTP/1.0\r\n\r\n"}) {
    request_reader reader;
    ASSERT_EQ(feed(reader, text), progress::complete);
    EXPECT_FALSE(reader.can_be_kept());
  }
}

TEST(missions_request_reader, bytes_at_random_never_break_it) {
  rc::check("random bytes", [](const std::string& bytes) {
    request_reader reader;
    RC_ASSERT(feed(reader, bytes) != progress::complete || !bytes.empty());
  });
}

} // namespace
} // namespace godwit::sim::missions
