#include "io/http/server/request_reader.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::io::http {
namespace request_reader_test {

// 100 bytes for one target, and what the settings say for the others.
std::size_t limits(std::string_view, std::string_view target) {
  return target == "/small" ? 100 : std::string_view::npos;
}

struct reading {
  server_settings set;
  body_limit limit = limits;
  request_reader reader{set, limit};

  progress feed(std::string_view text) {
    auto now = progress::more;
    while (!text.empty() && now == progress::more) {
      const auto piece = text.substr(0, request_reader::read_bytes);
      now = reader.feed(std::as_bytes(std::span(piece)));
      text.remove_prefix(piece.size());
    }
    return now;
  }
  unsigned refused(std::string_view text) { return feed(text) == progress::refused ? reader.refusal().status : 0; }
};

std::string posted(const std::string& target, const std::string& headers, const std::string& body) {
  return "POST " + target + " HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n" + headers + "\r\n" + body;
}

TEST(http_request_reader, a_request_is_read_with_its_headers_and_body) {
  reading it;
  ASSERT_EQ(it.feed(posted("/a?b=c", "authorization: Bearer x\r\nContent-Length: 2\r\n", "{}")), progress::complete);
  EXPECT_TRUE(it.reader.can_be_kept());
  const auto got = it.reader.take();
  EXPECT_EQ(got.method, "POST");
  EXPECT_EQ(got.target, "/a?b=c");
  EXPECT_EQ(got.find("Authorization"), "Bearer x");
  EXPECT_EQ(got.find("content-type"), "application/json");
  EXPECT_EQ(got.find("Cookie"), "");
  EXPECT_EQ(got.body, "{}");
}

TEST(http_request_reader, who_names_two_hosts_or_two_origins_is_refused) {
  for (const auto* const second : {"Host: y\r\n", "Host: x\r\n", "hOST:\r\n", "Origin: a\r\nOrigin: b\r\n"})
    EXPECT_EQ(reading().refused(posted("/a", std::string(second) + "Content-Length: 2\r\n", "{}")), 400U) << second;
  reading it;
  EXPECT_EQ(it.feed(posted("/a", "Origin: a\r\nContent-Length: 2\r\n", "{}")), progress::complete);
}

TEST(http_request_reader, requests_may_come_together_and_in_any_pieces) {
  const std::string chunked = posted("/a", "Transfer-Encoding: chunked\r\n", "3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n");
  const std::string empty = posted("/b", "Transfer-Encoding: chunked\r\n", "0\r\n\r\n");
  const std::string plain = posted("/c", "Content-Length: 3\r\n", "fgh");
  rc::check("in any pieces", [&](const std::vector<unsigned char>& sizes) {
    const std::string all = chunked + empty + plain;
    reading it;
    std::string bodies;
    std::size_t at = 0;
    for (std::size_t i = 0; at < all.size(); ++i) {
      const std::size_t size = sizes.empty() ? 1 : std::max<std::size_t>(1, sizes[i % sizes.size()] % 40U);
      auto now = it.feed(std::string_view(all).substr(at, size));
      at += size;
      while (now == progress::complete) {
        bodies += it.reader.take().body + "|";
        now = it.reader.next();
      }
      RC_ASSERT(now == progress::more);
    }
    RC_ASSERT(bodies == "abcde||fgh|");
  });
}

TEST(http_request_reader, a_body_that_is_too_large_is_refused_before_it_is_read) {
  EXPECT_EQ(reading().refused(posted("/small", "Content-Length: 101\r\n", "")), 413U); // the hook's bound
  EXPECT_EQ(reading().refused(posted("/", "Content-Length: 1048577\r\n", "")), 413U);  // max_body_bytes
  EXPECT_EQ(reading().refused(posted("/", "Content-Length: 99999999999\r\n", "")), 413U);
  reading kept;
  EXPECT_EQ(kept.refused(posted("/small", "Content-Length: 101\r\n", "")), 413U);
  EXPECT_FALSE(kept.reader.can_be_kept());
}

TEST(http_request_reader, a_chunked_body_ends_at_its_bound) {
  reading it;
  EXPECT_EQ(it.feed(posted("/small", "Transfer-Encoding: chunked\r\n", "64\r\n" + std::string(100, 'x') + "\r\n")),
            progress::more);
  EXPECT_EQ(it.refused("1\r\nx\r\n"), 413U);
}

TEST(http_request_reader, a_head_that_is_too_long_is_refused) {
  const std::string text = "GET / HTTP/1.1\r\nX: " + std::string(40'000, 'x');
  EXPECT_EQ(reading().refused(text), 431U);
  reading in_pieces;
  auto now = progress::more;
  std::size_t at = 0;
  for (; at < text.size() && now == progress::more; at += 1000)
    now = in_pieces.feed(std::string_view(text).substr(at, 1000));
  ASSERT_EQ(now, progress::refused);
  EXPECT_EQ(in_pieces.reader.refusal().status, 431U);
  EXPECT_LE(at, in_pieces.set.max_head_bytes + 1000);
}

TEST(http_request_reader, a_head_is_as_long_as_it_may_be_however_it_comes) {
  const std::size_t most = reading().set.max_head_bytes;
  const std::string begin = "GET / HTTP/1.1\r\nX: ";
  const std::string end = "\r\n\r\n";
  for (const std::size_t size : {most - 1, most, most + 1, most + 8}) {
    const std::string text = begin + std::string(size - begin.size() - end.size(), 'x') + end;
    const auto expected = size > most ? progress::refused : progress::complete;
    EXPECT_EQ(reading().feed(text), expected) << size;
    reading in_pieces;
    auto now = progress::more;
    for (std::size_t at = 0; at < text.size() && now == progress::more; ++at)
      now = in_pieces.feed(std::string_view(text).substr(at, 1));
    EXPECT_EQ(now, expected) << size << " in pieces";
  }
}

TEST(http_request_reader, a_target_that_is_too_long_is_refused) {
  EXPECT_EQ(reading().refused("GET /" + std::string(2048, 'x') + " HTTP/1.1\r\n\r\n"), 414U);
  EXPECT_EQ(reading().feed("GET /" + std::string(2047, 'x') + " HTTP/1.1\r\n\r\n"), progress::complete);
}

TEST(http_request_reader, what_is_no_http_is_refused) {
  for (const auto* text :
       {"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 hello of TLS\r\n\r\n", "HELO\r\n\r\n", "GET / HTTP/3.7\r\n\r\n",
        "GET  / HTTP/1.1\r\n\r\n", "GET / HTTP/1.1\r\nno colon\r\n\r\n", "GET / HTTP/1.1\r\n: no name\r\n\r\n"})
    EXPECT_EQ(reading().refused(text), 400U) << text;
}

// Two readers that differ about where a request ends are how one request is smuggled after another: RFC 9112, 11.2.
TEST(http_request_reader, a_length_that_can_be_read_in_two_ways_is_refused) {
  for (const auto* lines :
       {"Content-Length: -1\r\n", "Content-Length: 1\r\nContent-Length: 2\r\n", "Content-Length: 1, 2\r\n",
        "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n", "Transfer-Encoding: chunked\r\nContent-Length: 5\r\n"})
    EXPECT_EQ(reading().refused(posted("/", lines, "")), 400U) << lines;
  EXPECT_EQ(reading().refused(posted("/", "Transfer-Encoding: chunked\r\n", "zz\r\n")), 400U);
}

TEST(http_request_reader, a_line_that_two_readers_may_read_differently_stands_once) {
  for (const auto* lines :
       {"Host: y\r\n", "HOST: x\r\n", "Content-Type: text/plain\r\n", "Origin: http://x\r\nOrigin: http://y\r\n",
        "Authorization: Bearer a\r\nauthorization: Bearer b\r\n"})
    EXPECT_EQ(reading().refused(posted("/", lines, "")), 400U) << lines;
  EXPECT_EQ(reading().feed(posted("/", "Accept: a\r\nAccept: b\r\nContent-Length: 0\r\n", "")), progress::complete);
}

TEST(http_request_reader, headers_after_a_chunked_body_are_not_looked_at) {
  reading it;
  ASSERT_EQ(it.feed(posted("/", "Transfer-Encoding: chunked\r\n", "0\r\nAuthorization: Bearer x\r\n\r\n")),
            progress::complete);
  EXPECT_EQ(it.reader.take().find("Authorization"), "");
}

TEST(http_request_reader, who_waits_for_100_is_told_once_to_continue) {
  reading it;
  ASSERT_EQ(it.feed(posted("/", "Content-Length: 2\r\nExpect: 100-continue\r\n", "")), progress::more);
  EXPECT_TRUE(it.reader.take_continue());
  EXPECT_FALSE(it.reader.take_continue());
  EXPECT_EQ(it.feed("{}"), progress::complete);
}

TEST(http_request_reader, a_connection_that_is_to_close_is_not_kept) {
  for (const auto* text : {"GET / HTTP/1.1\r\nConnection: close\r\n\r\n", "GET / HTTP/1.0\r\n\r\n",
                           "GET / HTTP/1.0\r\nConnection: keep-alive\r\n\r\n"}) {
    reading it;
    ASSERT_EQ(it.feed(text), progress::complete);
    EXPECT_FALSE(it.reader.can_be_kept());
  }
}

TEST(http_request_reader, it_says_how_far_a_request_has_come) {
  reading it;
  EXPECT_FALSE(it.reader.has_begun());
  EXPECT_EQ(it.feed("P"), progress::more);
  EXPECT_TRUE(it.reader.has_begun());
  EXPECT_FALSE(it.reader.has_head());
  EXPECT_EQ(it.feed("OST / HTTP/1.1\r\nContent-Length: 3\r\n\r\nab"), progress::more);
  EXPECT_TRUE(it.reader.has_head());
  EXPECT_EQ(it.reader.body_bytes(), 2U);
  EXPECT_EQ(it.feed("cGET"), progress::complete);
  EXPECT_EQ(it.reader.unread(), "GET");
}

TEST(http_request_reader, bytes_at_random_never_break_it) {
  rc::check("random bytes", [](const std::string& bytes) {
    reading it;
    RC_ASSERT(it.feed(bytes) != progress::complete || !bytes.empty());
  });
}

} // namespace request_reader_test
} // namespace godwit::io::http
