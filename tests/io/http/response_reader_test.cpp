#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/http/response_reader.hpp"

namespace godwit::io::http {

namespace response_reader_test {

constexpr std::size_t small_body = 1024;

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

reader_rules plain_rules() {
  reader_rules rules;
  rules.max_body_bytes = small_body;
  return rules;
}

// Feeds TEXT and, where the answer is not complete by then, its end.
result<response> read(std::string_view text, reader_rules rules = plain_rules(), std::size_t piece_bytes = 4096,
                      bool ends_properly = true) {
  response_reader reader(std::move(rules));
  for (std::size_t at = 0; at < text.size() && !reader.is_complete(); at += piece_bytes)
    if (auto taken = reader.feed(bytes_of(text.substr(at, piece_bytes))); !taken)
      return tl::make_unexpected(taken.error());
  if (auto ended = reader.end_of_stream(ends_properly); !ended)
    return tl::make_unexpected(ended.error());
  return reader.take();
}

errc code_of(const result<response>& end) {
  if (end)
    ADD_FAILURE() << "taken as an answer with " << end->status;
  return end ? errc{} : end.error().code;
}

std::string chunked(const std::vector<std::string>& parts) {
  std::string text = "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\nX: y\r\n\r\n";
  for (const auto& part : parts) {
    std::array<char, 32> size{};
    std::snprintf(size.data(), size.size(), "%zx\r\n", part.size());
    text += size.data() + part + "\r\n";
  }
  return text + "0\r\n\r\n";
}

TEST(http_response_reader, reads_status_headers_and_body) {
  const auto end = read("HTTP/1.1 201 Created\r\nX-A: 1\r\nx-b:  2 \r\nContent-Length: 5\r\n\r\nhello");
  ASSERT_TRUE(end) << end.error().message();
  EXPECT_EQ(end->status, 201U);
  EXPECT_EQ(end->find("x-a"), "1");
  EXPECT_EQ(end->find("X-B"), "2");
  EXPECT_EQ(end->find("X-C"), "");
  EXPECT_EQ(end->body, "hello");
  EXPECT_EQ(end->body_bytes, 5U);
}

TEST(http_response_reader, needs_no_body_for_204_and_304) {
  EXPECT_EQ(read("HTTP/1.1 204 No Content\r\n\r\n")->status, 204U);
  EXPECT_EQ(read("HTTP/1.1 304 Not Modified\r\nContent-Length: 99999\r\n\r\n")->status, 304U);
}

RC_GTEST_PROP(http_response_reader, gives_the_same_answer_however_the_bytes_are_cut, ()) {
  const auto part = rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~')));
  const auto parts = *rc::gen::container<std::vector<std::string>>(part);
  const auto text = chunked(parts);
  const auto piece = *rc::gen::inRange<std::size_t>(1, text.size() + 1);
  std::string whole;
  for (const auto& each : parts)
    whole += each;
  RC_PRE(whole.size() <= small_body);
  const auto end = read(text, plain_rules(), piece);
  RC_ASSERT(end.has_value());
  RC_ASSERT(end->body == whole);
  RC_ASSERT(end->headers.size() == 2U);
}

TEST(http_response_reader, takes_an_empty_body_in_chunks_byte_by_byte) {
  for (std::size_t piece = 1; piece < 8; ++piece)
    EXPECT_EQ(read(chunked({}), plain_rules(), piece)->status, 200U) << piece;
}

TEST(http_response_reader, calls_an_answer_that_ends_early_truncated) {
  EXPECT_EQ(code_of(read("")), errc::connection_lost);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Le")), errc::truncated);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Length: 6\r\n\r\nhello")), errc::truncated);
  const auto text = chunked({"hello"});
  for (std::size_t size = 1; size < text.size(); ++size)
    EXPECT_EQ(code_of(read(std::string_view(text).substr(0, size))), errc::truncated) << size;
}

TEST(http_response_reader, takes_the_end_of_the_connection_for_the_end_of_the_body_only_when_it_was_said) {
  constexpr std::string_view text = "HTTP/1.1 200 OK\r\n\r\nhello";
  EXPECT_EQ(read(text)->body, "hello");
  EXPECT_EQ(code_of(read(text, plain_rules(), 4096, false)), errc::truncated);
}

TEST(http_response_reader, refuses_what_is_not_http) {
  for (const auto* text :
       {"SSH-2.0-OpenSSH_9.2\r\n", "HTTP/1.1 2000 OK\r\n\r\n", "HTTP/3.0 200 OK\r\n\r\n",
        "HTTP/1.1 200 OK\r\nbad header\r\n\r\n", "HTTP/1.1 200 OK\r\nContent-Length: -1\r\n\r\n",
        "HTTP/1.1 200 OK\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\nab",
        "HTTP/1.1 200 OK\r\nContent-Length: 1\r\nTransfer-Encoding: chunked\r\n\r\na",
        "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nxyz\r\n", "HTTP/1.1 101 Switching Protocols\r\n\r\n"})
    EXPECT_EQ(code_of(read(text)), errc::malformed) << text;
}

TEST(http_response_reader, bounds_the_head) {
  const std::string start = "HTTP/1.1 200 OK\r\n";
  EXPECT_EQ(code_of(read(start + "X: " + std::string(max_head_bytes, 'a') + "\r\n\r\n")), errc::header_too_large);
  std::string many = start;
  while (many.size() < 2 * max_head_bytes)
    many += "X: y\r\n";
  EXPECT_EQ(code_of(read(many)), errc::header_too_large);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 " + std::string(2 * max_head_bytes, 'a'), plain_rules(), 1000)),
            errc::header_too_large);
}

TEST(http_response_reader, bounds_the_head_of_a_chunk_and_what_follows_the_last) {
  const std::string start = "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n";
  EXPECT_EQ(code_of(read(start + "1;a=" + std::string(3 * max_head_bytes, 'b'), plain_rules(), 1000)), errc::malformed);
  std::string trailers = start + "0\r\n";
  while (trailers.size() < 3 * max_head_bytes)
    trailers += "X: y\r\n";
  EXPECT_EQ(code_of(read(trailers, plain_rules(), 1000)), errc::malformed);
}

TEST(http_response_reader, bounds_the_body_by_what_is_announced_and_by_what_comes) {
  const std::string too_much(small_body + 1, 'a');
  const auto announced = read("HTTP/1.1 200 OK\r\nContent-Length: 1025\r\n\r\n");
  EXPECT_EQ(code_of(announced), errc::body_too_large);
  EXPECT_NE(announced.error().message().find("1024 bytes"), std::string::npos);
  EXPECT_EQ(code_of(read(chunked({too_much}))), errc::body_too_large);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\n\r\n" + too_much)), errc::body_too_large);
  EXPECT_TRUE(read(chunked({std::string(small_body, 'a')})));
}

TEST(http_response_reader, keeps_the_status_of_an_error_page_that_is_too_long) {
  response_reader reader(plain_rules());
  ASSERT_TRUE(reader.feed(bytes_of("HTTP/1.1 503 Busy\r\nRetry-After: 7\r\nContent-Length: 1000000000\r\n\r\n")));
  const std::string page(read_piece_bytes, 'a');
  ASSERT_TRUE(reader.feed(bytes_of(page)));
  EXPECT_FALSE(reader.is_complete());
  ASSERT_TRUE(reader.feed(bytes_of(page)));
  ASSERT_TRUE(reader.is_complete());
  EXPECT_FALSE(reader.can_be_kept());
  const auto end = reader.take();
  EXPECT_EQ(end.status, 503U);
  EXPECT_EQ(end.find("Retry-After"), "7");
  EXPECT_TRUE(end.is_cut);
  EXPECT_EQ(end.body.size(), max_error_body_bytes);
}

TEST(http_response_reader, passes_over_some_interim_answers) {
  std::string text;
  for (unsigned n = 0; n < max_interim_answers; ++n)
    text += "HTTP/1.1 103 Early Hints\r\nLink: </a>\r\n\r\n";
  const std::string end = "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nok";
  EXPECT_EQ(read(text + end)->body, "ok");
  EXPECT_EQ(read(text + end)->find("Link"), "");
  EXPECT_EQ(code_of(read("HTTP/1.1 100 Continue\r\n\r\n" + text + end)), errc::malformed);
}

TEST(http_response_reader, refuses_what_was_compressed) {
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Encoding: gzip\r\nContent-Length: 1\r\n\r\na")), errc::encoded);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nTransfer-Encoding: gzip, chunked\r\n\r\n0\r\n\r\n")), errc::encoded);
  EXPECT_TRUE(read("HTTP/1.1 200 OK\r\nContent-Encoding: identity\r\nContent-Length: 1\r\n\r\na"));
}

TEST(http_response_reader, names_where_a_redirect_leads_without_its_query) {
  const auto end = read("HTTP/1.1 302 Found\r\nLocation: https://elsewhere.example/login?token=hunter2\r\n\r\n");
  ASSERT_EQ(code_of(end), errc::redirect);
  EXPECT_NE(end.error().message().find("https://elsewhere.example/login"), std::string::npos);
  EXPECT_EQ(end.error().message().find("hunter2"), std::string::npos);
}

TEST(http_response_reader, compares_the_content_type_of_a_success_with_the_expected_one) {
  auto rules = plain_rules();
  rules.expected_content_type = "application/json";
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Type: text/html\r\nContent-Length: 1\r\n\r\na", rules)),
            errc::wrong_content_type);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Length: 1\r\n\r\na", rules)), errc::wrong_content_type);
  EXPECT_TRUE(read("HTTP/1.1 404 Not Found\r\nContent-Type: text/html\r\nContent-Length: 1\r\n\r\na", rules));
  EXPECT_TRUE(read("HTTP/1.1 204 No Content\r\n\r\n", rules));
}

TEST(http_response_reader, gives_a_success_to_the_sink_and_an_error_page_to_the_answer) {
  std::string taken;
  auto rules = plain_rules();
  rules.on_body = [&](std::span<const std::byte> bytes) {
    taken.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return body_flow::more;
  };
  const auto page = read("HTTP/1.1 500 Oops\r\nContent-Length: 4\r\n\r\noops", rules);
  EXPECT_EQ(page->body, "oops");
  EXPECT_EQ(taken, "");
  const auto success = read(chunked({"hello ", "world"}), rules);
  EXPECT_EQ(success->body, "");
  EXPECT_EQ(success->body_bytes, 11U);
  EXPECT_EQ(taken, "hello world");
}

TEST(http_response_reader, stops_when_the_sink_wants_no_more) {
  auto rules = plain_rules();
  int calls = 0;
  rules.on_body = [&](std::span<const std::byte>) {
    ++calls;
    return body_flow::cancel;
  };
  EXPECT_EQ(code_of(read(chunked({"a", "b"}), rules)), errc::cancelled);
  EXPECT_EQ(calls, 1);
}

TEST(http_response_reader, allows_to_keep_a_connection_only_when_both_sides_agree) {
  const auto kept = [](std::string_view text) {
    response_reader reader(plain_rules());
    return reader.feed(bytes_of(text)).has_value() && reader.can_be_kept();
  };
  EXPECT_TRUE(kept("HTTP/1.1 200 OK\r\nContent-Length: 1\r\n\r\na"));
  EXPECT_FALSE(kept("HTTP/1.1 200 OK\r\nContent-Length: 1\r\nConnection: close\r\n\r\na"));
  EXPECT_FALSE(kept("HTTP/1.1 200 OK\r\nContent-Length: 1\r\n\r\nab")); // what is that b?
  EXPECT_FALSE(kept("HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\na"));
  EXPECT_FALSE(kept("HTTP/1.0 200 OK\r\nContent-Length: 1\r\n\r\na"));
}

TEST(http_response_reader, expects_no_body_of_a_proxy_that_lets_us_through) {
  auto rules = plain_rules();
  rules.is_connect = true;
  response_reader reader(rules);
  for (const char each : std::string_view("HTTP/1.1 200 Connection established\r\n\r\n"))
    ASSERT_TRUE(reader.feed(bytes_of({&each, 1})));
  EXPECT_TRUE(reader.is_complete());
  EXPECT_FALSE(reader.has_leftover());
}

} // namespace response_reader_test

namespace head_rules_test {

response head(unsigned status, std::vector<header> headers = {}) { return {status, std::move(headers), {}, 0, false}; }

TEST(http_head_rules, refuse_every_redirect_and_no_304) {
  for (const unsigned status : {300U, 301U, 302U, 303U, 305U, 307U, 308U, 399U})
    EXPECT_EQ(judge_head(head(status), {}).error().code, errc::redirect) << status;
  for (const unsigned status : {200U, 204U, 304U, 400U, 503U})
    EXPECT_TRUE(judge_head(head(status), "")) << status;
}

TEST(http_head_rules, refuse_every_second_coding_too) {
  EXPECT_EQ(judge_head(head(200, {{"Content-Encoding", "identity"}, {"content-encoding", "br"}}), {}).error().code,
            errc::encoded);
  EXPECT_TRUE(judge_head(head(200, {{"Transfer-Encoding", "Chunked"}}), {}));
}

TEST(http_head_rules, quote_what_is_foreign_without_control_characters_queries_and_length) {
  EXPECT_EQ(quotable("https://a/b?token=c"), "https://a/b");
  EXPECT_EQ(quotable("a\x1b[31m\nb\xff"), "a?[31m?b?");
  EXPECT_EQ(quotable(std::string(1000, 'a')), std::string(200, 'a') + "...");
}

} // namespace head_rules_test

} // namespace godwit::io::http
