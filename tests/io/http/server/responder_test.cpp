#include "io/http/server/responder.hpp"

#include <atomic>
#include <optional>
#include <thread>
#include <utility>

#include <boost/asio/write.hpp>

#include "tests/io/http/server/server_fixture.hpp"

namespace godwit::io::http::test {
namespace responder_test {

// Keeps its answers until the test gives them.
struct holding {
  std::optional<responder> held;
  running_server server{[this](auto, responder answer) { held.emplace(std::move(answer)); }};
  raw_client client{server};

  void ask(const std::string& text) {
    client.write(text);
    ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  }
};

TEST(http_responder, answers_later_and_from_any_thread) {
  holding it;
  it.ask(get("/"));
  std::thread([&] { it.held->send({.body = "late"}); }).join();
  EXPECT_EQ(it.client.read().body(), "late");
}

TEST(http_responder, that_is_dropped_without_an_answer_resets_the_connection) {
  running_server server([](auto, const responder&) {});
  raw_client client(server);
  client.write(get("/"));
  EXPECT_EQ(client.read_to_end(), "");
  EXPECT_TRUE(client.was_reset());
  EXPECT_EQ(server.counters().aborted, 1U);
}

TEST(http_responder, aborts_with_a_reset_that_the_client_sees) {
  holding it;
  it.ask(get("/"));
  it.held->abort();
  EXPECT_EQ(it.client.read_to_end(), "");
  EXPECT_TRUE(it.client.was_reset());
}

TEST(http_responder, gives_an_answer_piece_by_piece_and_the_connection_is_kept) {
  running_server server([](const server_request& asked, responder answer) {
    const auto kept = std::make_shared<responder>(std::move(answer));
    kept->start({.body = "ab"}, 5, [kept, asked] { kept->write("cde", [kept] { kept->finish(); }); });
  });
  raw_client client(server);
  client.write(get("/") + "HEAD / HTTP/1.1\r\n\r\n" + get("/"));
  EXPECT_EQ(client.read().body(), "abcde");
  EXPECT_EQ(client.read(true)["Content-Length"], "5");
  EXPECT_EQ(client.read().body(), "abcde");
}

TEST(http_responder, a_body_without_a_length_ends_with_the_connection) {
  running_server server([](auto, responder answer) {
    const auto kept = std::make_shared<responder>(std::move(answer));
    kept->start({.content_type = "text/event-stream", .body = "data: 1\n\n"}, std::nullopt,
                [kept] { kept->write("data: 2\n\n", [kept] { kept->finish(); }); });
  });
  raw_client client(server);
  client.write(get("/"));
  EXPECT_TRUE(client.read_to_end().ends_with("Connection: close\r\n\r\ndata: 1\n\ndata: 2\n\n"));
  EXPECT_FALSE(client.was_reset());
}

TEST(http_responder, less_or_more_than_was_promised_resets_the_connection) {
  for (const std::string second : {"c", "cdef"}) {
    running_server server([&](auto, responder answer) {
      const auto kept = std::make_shared<responder>(std::move(answer));
      kept->start({.body = "ab"}, 5, [kept, second] { kept->write(second, [kept] { kept->finish(); }); });
    });
    raw_client client(server);
    client.write(get("/"));
    EXPECT_TRUE(server.reaches(&server_counters::aborted, 1)) << second;
  }
}

TEST(http_responder, tells_when_the_client_has_gone_once_and_not_when_it_had_its_answer) {
  std::optional<responder> held;
  int gone = 0;
  running_server server([&](auto, responder answer) {
    answer.on_gone([&] {
      ++gone;
      held.reset(); // as whoever holds long polls would
    });
    held.emplace(std::move(answer));
  });
  raw_client client(server);
  client.write(get("/"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  server.inside([&](auto&) { held->send({}); });
  EXPECT_EQ(client.read().result_int(), 200U);
  client.write(get("/"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 2));
  client.close();
  ASSERT_TRUE(server.reaches(&server_counters::open, 0));
  server.inside([&](auto&) { EXPECT_EQ(gone, 1); });
  EXPECT_EQ(server.counters().aborted, 0U);
}

TEST(http_responder, that_outlives_its_server_does_nothing) {
  holding it;
  it.ask(get("/"));
  it.server.destroy_server();
  it.held->send({.body = "too late"});
  EXPECT_EQ(it.client.read_to_end(), "");
}

TEST(http_responder, hands_the_connection_over_with_what_the_client_said_early) {
  std::unique_ptr<connection> taken;
  running_server server([&](auto, responder answer) {
    answer.upgrade([&](std::unique_ptr<connection> given, const std::string& early) {
      taken = std::move(given);
      boost::asio::write(taken->socket(), boost::asio::buffer("HTTP/1.1 101 \r\n\r\n" + early));
      taken->close();
    });
  });
  raw_client client(server);
  client.write(get("/", "Connection: upgrade\r\nUpgrade: echo\r\n") + "hello");
  EXPECT_EQ(client.read_to_end(), "HTTP/1.1 101 \r\n\r\nhello");
  EXPECT_EQ(server.counters().upgraded, 1U);
  EXPECT_EQ(server.counters().open, 0U);
}

} // namespace responder_test
} // namespace godwit::io::http::test
