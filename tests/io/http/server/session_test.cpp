// What a connection does with what comes over it: one test for each rule, bound and time-out.
#include "io/http/server/session.hpp"

#include <optional>
#include <utility>

#include "tests/io/http/server/server_fixture.hpp"

namespace godwit::io::http::test {
namespace session_test {

constexpr std::chrono::milliseconds never{long_time};

// Only the time-out that a test is about may end a connection.
server_settings patient() {
  server_settings set;
  set.handshake_timeout = set.idle_timeout = set.head_timeout = set.body_timeout = set.write_timeout = never;
  return set;
}

std::string post(const std::string& target, const std::string& headers, const std::string& body = {}) {
  return "POST " + target + " HTTP/1.1\r\nHost: x\r\n" + headers + "\r\n" + body;
}

void say_body(server_request asked, responder answer) { answer.send({.body = std::move(asked.body)}); }

TEST(http_session, a_connection_is_kept_for_the_next_request) {
  running_server server;
  raw_client client(server);
  for (const std::string target : {"/a", "/b", "/c"}) {
    client.write(get(target));
    EXPECT_EQ(client.read().body(), target);
  }
  EXPECT_EQ(server.counters().accepted, 1U);
  EXPECT_EQ(server.counters().requests, 3U);
  EXPECT_TRUE(server.reaches(&server_counters::answered, 3));
}

TEST(http_session, a_request_says_which_address_it_comes_from_and_which_it_has_asked) {
  running_server server(
      [](const server_request& asked, responder answer) { answer.send({.body = asked.from + " " + asked.to}); });
  raw_client client(server);
  client.write(get("/"));
  EXPECT_EQ(client.read().body(), "127.0.0.1 127.0.0.1");
}

TEST(http_session, what_is_kept_unread_can_be_handed_over_later) {
  std::optional<responder> held;
  running_server server([&](const server_request&, responder answer) {
    answer.keep_unread();
    held.emplace(std::move(answer));
  });
  raw_client client(server);
  client.write(get("/"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  client.write("more");
  bool is_taken = false;
  server.inside([&](auto&) {
    held->upgrade([&](std::unique_ptr<connection> taken, const std::string&) { is_taken = taken != nullptr; });
  });
  EXPECT_TRUE(is_taken);
  EXPECT_EQ(server.counters().upgraded, 1U);
}

TEST(http_session, requests_that_come_together_are_answered_in_their_order) {
  running_server server;
  raw_client client(server);
  client.write(get("/a") + post("/b", "Content-Length: 3\r\n", "abc") + get("/c"));
  for (const auto* target : {"/a", "/b", "/c"})
    EXPECT_EQ(client.read().body(), target);
}

TEST(http_session, what_comes_while_an_answer_is_awaited_is_the_next_request) {
  std::optional<responder> held;
  running_server server([&](server_request asked, responder answer) {
    if (asked.target == "/later")
      held.emplace(std::move(answer));
    else
      say_target(std::move(asked), std::move(answer));
  });
  raw_client client(server);
  client.write(get("/later"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  client.write(get("/next"));
  server.inside([&](auto&) { held->send({.body = "late"}); });
  EXPECT_EQ(client.read().body(), "late");
  EXPECT_EQ(client.read().body(), "/next");
}

TEST(http_session, the_last_of_max_requests_closes_the_connection) {
  auto set = patient();
  set.max_requests = 2;
  running_server server(say_target, set);
  raw_client client(server);
  client.write(get("/a") + get("/b") + get("/c"));
  EXPECT_TRUE(client.read().keep_alive());
  EXPECT_FALSE(client.read().keep_alive());
  EXPECT_EQ(client.read_to_end(), "");
  EXPECT_EQ(server.counters().requests, 2U);
}

TEST(http_session, a_client_that_says_close_gets_its_answer_and_the_end) {
  running_server server;
  raw_client client(server);
  client.write(get("/a", "Connection: close\r\n"));
  EXPECT_TRUE(client.read_to_end().ends_with("Connection: close\r\n\r\n/a"));
}

TEST(http_session, http_1_0_has_one_request_a_connection) {
  running_server server;
  raw_client client(server);
  client.write("GET /a HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
  EXPECT_TRUE(client.read_to_end().ends_with("Connection: close\r\n\r\n/a"));
}

TEST(http_session, head_gets_the_length_and_no_body) {
  running_server server;
  raw_client client(server);
  client.write("HEAD /abc HTTP/1.1\r\nHost: x\r\n\r\n" + get("/next"));
  EXPECT_EQ(client.read(true)["Content-Length"], "4");
  EXPECT_EQ(client.read().body(), "/next");
}

TEST(http_session, no_content_has_no_body_whatever_the_handler_gives) {
  running_server server([](auto, responder answer) { answer.send({.status = 204, .body = "x"}); });
  raw_client client(server);
  client.write(get("/") + get("/"));
  EXPECT_EQ(client.read().result_int(), 204U);
  EXPECT_EQ(client.read().result_int(), 204U);
}

TEST(http_session, who_waits_for_100_is_told_to_continue) {
  running_server server(say_body);
  raw_client client(server);
  client.write(post("/", "Content-Length: 3\r\nExpect: 100-continue\r\nConnection: close\r\n"));
  ASSERT_TRUE(client.hears_within(never));
  client.write("abc");
  const auto all = client.read_to_end();
  EXPECT_TRUE(all.starts_with("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK\r\n")) << all;
  EXPECT_TRUE(all.ends_with("\r\n\r\nabc"));
}

TEST(http_session, a_malformed_head_is_answered_with_400_and_closed) {
  running_server server;
  raw_client client(server);
  client.write("HELO\r\n\r\n");
  const auto all = client.read_to_end();
  EXPECT_TRUE(all.starts_with("HTTP/1.1 400 Bad Request\r\nContent-Type: application/problem+json\r\n")) << all;
  EXPECT_EQ(server.counters().malformed, 1U);
  EXPECT_EQ(server.counters().requests, 0U);
}

TEST(http_session, a_head_above_max_head_bytes_is_answered_with_431) {
  auto set = patient();
  set.max_head_bytes = 200;
  running_server server(say_target, set);
  raw_client client(server);
  client.write(get("/", "X: " + std::string(200, 'x') + "\r\n"));
  EXPECT_TRUE(client.read_to_end().starts_with("HTTP/1.1 431 "));
  EXPECT_EQ(server.counters().head_too_large, 1U);
}

TEST(http_session, a_target_above_max_target_bytes_is_answered_with_414) {
  auto set = patient();
  set.max_target_bytes = 10;
  running_server server(say_target, set);
  raw_client client(server);
  client.write(get("/" + std::string(10, 'x')));
  EXPECT_TRUE(client.read_to_end().starts_with("HTTP/1.1 414 "));
  EXPECT_EQ(server.counters().head_too_large, 1U);
}

TEST(http_session, a_body_above_max_body_bytes_gets_its_answer_while_it_is_still_being_sent) {
  auto set = patient();
  set.max_body_bytes = 1000;
  set.close_timeout = never;
  running_server server(say_body, set);
  raw_client client(server);
  client.write(post("/", "Content-Length: 5000000\r\n", std::string(5'000'000, 'x')));
  client.close_sending();
  EXPECT_TRUE(client.read_to_end().starts_with("HTTP/1.1 413 "));
  EXPECT_FALSE(client.was_reset());
  EXPECT_EQ(server.counters().body_too_large, 1U);
}

TEST(http_session, idle_timeout_ends_a_connection_without_a_request) {
  auto set = patient();
  set.idle_timeout = short_time;
  running_server server(say_target, set);
  raw_client silent(server);
  EXPECT_EQ(silent.read_to_end(), "");
  raw_client between(server);
  between.write(get("/a"));
  EXPECT_EQ(between.read().body(), "/a");
  EXPECT_EQ(between.read_to_end(), "");
  EXPECT_EQ(server.counters().idle_timeouts, 2U);
  EXPECT_EQ(server.counters().lost, 0U);
}

TEST(http_session, head_timeout_ends_a_slow_loris_however_steadily_it_goes_on) {
  auto set = patient();
  set.head_timeout = short_time;
  running_server server(say_target, set);
  raw_client client(server);
  client.write("GET / HTTP/1.1\r\nX: ");
  EXPECT_TRUE(client.dribble_until_closed());
  EXPECT_EQ(server.counters().head_timeouts, 1U);
}

TEST(http_session, body_timeout_ends_a_slow_loris_in_the_body) {
  auto set = patient();
  set.head_timeout = set.body_timeout = short_time;
  running_server server(say_body, set);
  raw_client client(server);
  client.write(post("/", "Content-Length: 1000000\r\n"));
  EXPECT_TRUE(client.dribble_until_closed());
  EXPECT_EQ(server.counters().body_timeouts, 1U);
}

TEST(http_session, a_body_of_min_bytes_per_s_is_not_ended) {
  auto set = patient();
  set.head_timeout = set.body_timeout = short_time;
  set.min_bytes_per_s = 1; // ten bytes: ten seconds more
  running_server server(say_body, set);
  raw_client client(server);
  client.write(post("/", "Content-Length: 11\r\n", "0123456789"));
  EXPECT_FALSE(client.hears_within(4 * short_time));
  client.write("x");
  EXPECT_EQ(client.read().body(), "0123456789x");
}

TEST(http_session, write_timeout_ends_a_client_that_takes_nothing) {
  auto set = patient();
  set.write_timeout = short_time;
  running_server server([](auto, responder answer) { answer.send({.body = std::string(64'000'000, 'x')}); }, set);
  raw_client client(server);
  client.write(get("/"));
  EXPECT_TRUE(server.reaches(&server_counters::write_timeouts, 1));
  EXPECT_EQ(server.counters().answered, 0U);
}

TEST(http_session, close_timeout_ends_a_client_that_does_not_close_too) {
  auto set = patient();
  set.close_timeout = short_time;
  running_server server(say_target, set);
  raw_client client(server);
  client.write(get("/", "Connection: close\r\n"));
  EXPECT_TRUE(server.reaches(&server_counters::answered, 1));
  EXPECT_TRUE(server.reaches(&server_counters::open, 0));
}

TEST(http_session, a_client_that_goes_in_the_middle_is_counted) {
  std::optional<responder> held;
  running_server server([&](auto, responder answer) { held.emplace(std::move(answer)); }, patient());
  std::uint64_t lost = 0;
  for (const auto& text : {std::string("GET / HT"), post("/", "Content-Length: 3\r\n", "ab"), get("/")}) {
    raw_client client(server);
    client.write(text);
    client.close_sending();
    EXPECT_EQ(client.read_to_end(), "");
    EXPECT_TRUE(server.reaches(&server_counters::lost, ++lost)) << text;
  }
  EXPECT_EQ(server.counters().requests, 1U);
  EXPECT_EQ(server.counters().open, 0U);
}

TEST(http_session, an_answer_goes_out_to_a_client_that_has_closed_its_sending_side_by_then) {
  running_server server;
  raw_client client(server);
  client.write(get("/a"));
  ASSERT_TRUE(client.hears_within(never));
  client.close_sending();
  EXPECT_TRUE(client.read_to_end().ends_with("\r\n\r\n/a"));
}

} // namespace session_test
} // namespace godwit::io::http::test
