// The stream as clients of WebSockets see it: quick ones, slow ones, and strangers.
#include "programs/godwitd/operator_port/stream_api.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwitd/operator_port/operator_port.hpp"
#include "tests/io/http/server/server_fixture.hpp"
#include "tests/io/http/server/websocket_client.hpp"

namespace stream_api_test {

using namespace godwit;
using namespace godwit::operator_port;
using namespace godwit::telemetry_stream;
using namespace std::chrono_literals;
using io::http::test::raw_client;
using io::http::test::websocket_client;
using nlohmann::json;

class streamed : public testing::Test {
protected:
  streamed() {
    api = std::make_shared<stream_api>(port.context(), all, set);
    auto routes = api->routes();
    for (auto& each : routes)
      each.handle = [this, then = each.handle](server_request asked, responder answer) {
        if (const auto place = asked.place.lock(); place && !session.empty())
          place->prove(session);
        then(std::move(asked), std::move(answer));
      };
    EXPECT_TRUE(port.open({.host = "127.0.0.1", .port = 0, .hosts = {}}, std::move(routes)));
    number = static_cast<std::uint16_t>(std::stoi(port.place().substr(port.place().find(':') + 1)));
  }
  ~streamed() override {
    port.close([this] { api->close(); });
  }

  void say(topic what, const json& data) { all->publish(what, data.dump(), 5, ++now_ns); }
  bool subscribed(std::uint64_t wanted) {
    for (int i = 0; i < 2000 && all->counts().subscribers != wanted; ++i)
      std::this_thread::sleep_for(5ms);
    return all->counts().subscribers == wanted;
  }
  // The next text that is not about the stream itself.
  static json next(websocket_client& client) {
    for (;;) {
      const auto text = client.read();
      if (text.empty())
        return {};
      auto said = json::parse(text);
      if (said.at("topic") != "stream")
        return said;
    }
  }

  std::string session; // with which clients come
  std::int64_t now_ns = 1'000'000'000;
  io::http::websocket_settings set{.write_timeout = std::chrono::seconds(60)};
  std::shared_ptr<hub> all = std::make_shared<hub>(42);
  class port port;
  std::shared_ptr<stream_api> api;
  std::uint16_t number = 0;
};

TEST_F(streamed, a_client_hears_the_stream_the_newest_and_then_what_comes) {
  say(topic::flight, "ready");
  websocket_client client(number, "/api/v1/stream?topics=flight,position@10");
  ASSERT_EQ(client.status(), 101U);
  EXPECT_EQ(json::parse(client.read()).at("data").at("session"), "42");
  EXPECT_EQ(next(client).at("data"), "ready");
  say(topic::position, 1);
  EXPECT_EQ(next(client).at("data"), 1);
  say(topic::flight, "flying");
  EXPECT_EQ(next(client).at("data"), "flying");
}

TEST_F(streamed, a_client_is_closed_when_its_session_ends_and_no_other_one) {
  session = "s1";
  websocket_client anna(number, "/api/v1/stream?topics=flight");
  ASSERT_EQ(anna.status(), 101U);
  session = "s2";
  websocket_client bob(number, "/api/v1/stream?topics=flight");
  ASSERT_EQ(bob.status(), 101U);
  ASSERT_TRUE(subscribed(2));
  const auto since = std::chrono::steady_clock::now();
  port.end_session("s1");
  EXPECT_TRUE(next(anna).is_null());
  EXPECT_LT(std::chrono::steady_clock::now() - since, 500ms) << "accounts are looked at each half second";
  EXPECT_TRUE(subscribed(1));
  say(topic::flight, "flying");
  EXPECT_EQ(next(bob).at("data"), "flying");
}

TEST_F(streamed, what_is_asked_wrongly_is_answered_with_what_is_right) {
  raw_client plain(number);
  plain.write("GET /api/v1/stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto answer = plain.read();
  EXPECT_EQ(answer.result_int(), 426U);
  EXPECT_EQ(answer["Upgrade"], "websocket");
  EXPECT_EQ(websocket_client(number, "/api/v1/stream?topics=positions").status(), 400U);
  EXPECT_EQ(websocket_client(number, "/api/v1/streams").status(), 404U);
}

TEST_F(streamed, a_page_of_another_site_gets_no_websocket) {
  EXPECT_EQ(websocket_client(number, "/api/v1/stream", "http://evil.example").status(), 403U);
  EXPECT_EQ(websocket_client(number, "/api/v1/stream", "http://localhost:" + std::to_string(number)).status(), 101U);
}

TEST_F(streamed, who_says_something_is_closed_and_leaves_no_place_behind) {
  websocket_client client(number, "/api/v1/stream");
  EXPECT_TRUE(subscribed(1));
  client.write("{}");
  while (!client.read().empty()) {
  }
  EXPECT_EQ(client.close_code(), 1008U);
  EXPECT_TRUE(subscribed(0));
}

TEST_F(streamed, a_client_that_reads_nothing_is_dropped_from_and_the_others_hear_all) {
  websocket_client stalled(number, "/api/v1/stream?topics=position");
  websocket_client quick(number, "/api/v1/stream?topics=position");
  ASSERT_TRUE(subscribed(2));
  const std::string long_one(4000, 'x');
  constexpr int texts = 2000; // 8 MB: more than the system takes for who does not read
  for (int i = 0; i < texts; ++i) {
    say(topic::position, std::to_string(i) + long_one);
    EXPECT_TRUE(next(quick).at("data").get<std::string>().starts_with(std::to_string(i))) << i;
  }
  const auto counted = all->counts();
  EXPECT_GT(counted.dropped[static_cast<std::size_t>(topic::position)], 1000U);
  EXPECT_EQ(counted.ended, 0U);
  bool was_told = false;
  for (int i = 0; i < texts && !was_told; ++i)
    was_told = stalled.read().find("\"dropped\":{\"position\":") != std::string::npos;
  EXPECT_TRUE(was_told);
}

TEST_F(streamed, a_client_that_misses_what_must_arrive_is_ended_with_the_reason) {
  websocket_client stalled(number, "/api/v1/stream?topics=flight");
  ASSERT_TRUE(subscribed(1));
  const std::string long_one(4000, 'x');
  for (int i = 0; i < 2000; ++i)
    say(topic::flight, long_one);
  EXPECT_EQ(all->counts().ended, 1U);
  while (!stalled.read().empty()) {
  }
  EXPECT_EQ(stalled.close_code(), 1013U);
  EXPECT_TRUE(subscribed(0));
}

class hasty : public streamed {
protected:
  hasty() {
    port.close([this] { api->close(); });
    set.write_timeout = 1s;
    api = std::make_shared<stream_api>(second.context(), all, set);
    EXPECT_TRUE(second.open({.host = "127.0.0.1", .port = 0, .hosts = {}}, api->routes()));
    number = static_cast<std::uint16_t>(std::stoi(second.place().substr(second.place().find(':') + 1)));
  }
  ~hasty() override {
    second.close([this] { api->close(); });
  }
  class port second;
};

TEST_F(hasty, a_client_that_takes_nothing_for_long_is_closed) {
  websocket_client stalled(number, "/api/v1/stream?topics=position");
  ASSERT_TRUE(subscribed(1));
  for (int i = 0; i < 2000; ++i)
    say(topic::position, std::string(4000, 'x'));
  EXPECT_TRUE(subscribed(0));
}

TEST_F(streamed, a_websocket_is_one_of_the_clients_of_its_address_for_as_long_as_it_lasts) {
  session = "s1"; // who has none gives way
  std::vector<std::unique_ptr<websocket_client>> lines;
  for (std::size_t i = 0; i < settings().max_clients_an_address; ++i) {
    lines.push_back(std::make_unique<websocket_client>(number, "/api/v1/stream"));
    EXPECT_EQ(lines.back()->status(), 101U) << i;
  }
  EXPECT_EQ(websocket_client(number, "/api/v1/stream").status(), 0U);
  lines.pop_back();
  for (int i = 0; i < 500; ++i) {
    if (websocket_client(number, "/api/v1/stream").status() == 101U)
      return;
    std::this_thread::sleep_for(5ms);
  }
  FAIL() << "the place was never free";
}

} // namespace stream_api_test
