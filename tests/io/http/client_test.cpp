#include "io/http/client.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <semaphore>
#include <string>
#include <thread>
#include <utility>

#include "io/http/response_reader.hpp"
#include "tests/io/http/http_fixture.hpp"

namespace godwit::io::http::test {
namespace client_test {

using http_client = http_fixture;

request to(std::string target) {
  request asked;
  asked.target = std::move(target);
  return asked;
}

void hold(http_peer& peer, const http_request&) { peer.wait_until_gone(); }

void say_ok(http_peer& peer, const http_request&) { peer.write(http_answer("200 OK", "ok")); }

// What callbacks have said, in a form that other threads can wait for.
class endings {
public:
  client::done next() {
    return [this](const result<response>& end) {
      (end ? answered : end.error().code == errc::cancelled ? cancelled : otherwise)++;
      called.release();
    };
  }
  bool wait(int n) {
    for (int i = 0; i < n; ++i)
      if (!called.try_acquire_for(patience))
        return false;
    return true;
  }
  std::atomic<int> answered{0};
  std::atomic<int> cancelled{0};
  std::atomic<int> otherwise{0};
  std::counting_semaphore<> called{0};
};

TEST_F(http_client, brings_the_answer_of_the_service) {
  const http_server server([](http_peer& peer, const http_request& asked) {
    peer.write(
        http_answer("200 OK", std::string(asked.target()), "X-Method: " + std::string(asked.method_string()) + "\r\n"));
  });
  const auto end = ask(server.url() + "/api", to("/missions/7?after=3"));
  ASSERT_TRUE(end) << end.error().message();
  EXPECT_EQ(end->status, 200U);
  EXPECT_EQ(end->find("x-method"), "GET");
  EXPECT_EQ(end->body, "/api/missions/7?after=3");
}

TEST_F(http_client, brings_it_over_tls_too) {
  const http_server server(say_ok, with_tls());
  EXPECT_EQ(body_of(ask(server.url())), "ok");
  EXPECT_EQ(body_of(ask(server.url("localhost"))), "ok"); // a name instead of an address
}

TEST_F(http_client, sends_a_body_that_needs_many_pieces) {
  const http_server server(
      [](http_peer& peer, const http_request& asked) {
        peer.write(http_answer("201 Created", std::to_string(std::hash<std::string>{}(asked.body()))));
      },
      with_tls());
  request asked;
  asked.method = method::post;
  for (std::size_t i = 0; asked.body.size() < 1'000'000; ++i)
    asked.body += std::to_string(i);
  const auto expected = std::to_string(std::hash<std::string>{}(asked.body));
  EXPECT_EQ(body_of(ask(server.url(), asked)), expected);
}

TEST_F(http_client, takes_any_status_for_an_answer) {
  const http_server server([](http_peer& peer, const http_request& asked) {
    peer.write(http_answer(std::string(asked.target().substr(1)) + " Whatever", "no"));
  });
  const auto service = open(settings_for(server.url()));
  for (const unsigned status : {400U, 404U, 410U, 429U, 500U, 503U})
    EXPECT_EQ(status_of(ask(*service, to("/" + std::to_string(status)))), status);
}

TEST_F(http_client, sends_the_token_as_it_stands_in_the_file_at_that_time) {
  const http_server server([](http_peer& peer, const http_request& asked) {
    peer.write(http_answer("200 OK", backwards(asked["Authorization"])));
  });
  auto wanted = settings_for(server.url());
  wanted.token_file = store("token", "first\n");
  const auto service = open(wanted);
  EXPECT_EQ(body_of(ask(*service, {})), backwards("Bearer first"));
  store("token", "second\n");
  EXPECT_EQ(body_of(ask(*service, {})), backwards("Bearer second"));
}

TEST_F(http_client, sends_nothing_when_the_token_can_not_be_read) {
  const http_server server(say_ok);
  auto wanted = settings_for(server.url());
  wanted.token_file = store("token", "hunter2", 0644);
  const auto end = ask(*open(wanted), {});
  EXPECT_EQ(code_of(end), errc::token_file);
  EXPECT_EQ(end.error().where, wanted.token_file);
  EXPECT_EQ(end.error().message().find("hunter2"), std::string::npos);
  EXPECT_EQ(server.connections(), 0);
}

TEST_F(http_client, keeps_its_connection) {
  const http_server server(say_ok, with_tls());
  const auto service = open(settings_for(server.url()));
  for (int i = 0; i < 5; ++i)
    ASSERT_TRUE(ask(*service, {}));
  EXPECT_EQ(server.connections(), 1);
  EXPECT_EQ(service->counters().connections, 1U);
  EXPECT_EQ(service->counters().reused, 4U);
  EXPECT_EQ(service->counters().kept, 1U);
}

TEST_F(http_client, does_not_keep_a_connection_for_longer_than_it_may) {
  const http_server server(say_ok);
  auto wanted = settings_for(server.url());
  wanted.keep_for = std::chrono::milliseconds(0);
  const auto service = open(wanted);
  ASSERT_TRUE(ask(*service, {}));
  ASSERT_TRUE(ask(*service, {}));
  EXPECT_EQ(server.connections(), 2);
}

TEST_F(http_client, calls_back_once_for_each_of_many_requests_from_many_threads) {
  const http_server server(say_ok);
  const auto service = open(settings_for(server.url()));
  endings seen;
  constexpr int each = 16;
  {
    std::array<std::jthread, 4> senders;
    for (auto& sender : senders)
      sender = std::jthread([&] {
        for (int i = 0; i < each; ++i)
          EXPECT_TRUE(service->send({}, seen.next()));
      });
  }
  ASSERT_TRUE(seen.wait(4 * each));
  EXPECT_EQ(seen.answered, 4 * each);
  EXPECT_LE(server.connections(), 4 * each);
  EXPECT_EQ(service->counters().under_way, 0U);
  EXPECT_EQ(service->counters().answered, 4U * each);
}

TEST_F(http_client, has_a_bounded_number_of_connections_and_of_requests_that_wait) {
  const http_server server(hold);
  auto wanted = settings_for(server.url());
  wanted.max_under_way = 2;
  wanted.max_waiting = 3;
  endings seen;
  {
    const auto service = open(wanted);
    for (int i = 0; i < 5; ++i)
      ASSERT_TRUE(service->send({}, seen.next()));
    const auto refused = service->send({}, seen.next());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, errc::too_many);
    EXPECT_EQ(service->counters().refused, 1U);
  }
  EXPECT_EQ(seen.cancelled, 5); // and none for the one that was refused
  EXPECT_EQ(seen.otherwise, 0);
  EXPECT_LE(server.connections(), 2);
}

TEST_F(http_client, has_a_place_free_again_when_a_callback_is_called) {
  const http_server server(say_ok);
  auto wanted = settings_for(server.url());
  wanted.max_under_way = 1;
  wanted.max_waiting = 0;
  const auto service = open(wanted);
  endings seen;
  ASSERT_TRUE(service->send({}, [&](const result<response>& end) {
    EXPECT_TRUE(end);
    EXPECT_TRUE(service->send({}, seen.next()));
  }));
  ASSERT_TRUE(seen.wait(1));
  EXPECT_EQ(seen.answered, 1);
}

TEST_F(http_client, cancels_what_is_under_way_and_what_waits) {
  const http_server server(hold);
  auto wanted = settings_for(server.url());
  wanted.max_under_way = 1;
  const auto service = open(wanted);
  endings seen;
  const auto first = service->send({}, seen.next());
  const auto second = service->send({}, seen.next());
  service->cancel(*second);
  ASSERT_TRUE(seen.wait(1));
  service->cancel(*first);
  ASSERT_TRUE(seen.wait(1));
  service->cancel(*first); // has ended
  service->cancel(999);    // was never there
  EXPECT_EQ(seen.cancelled, 2);
  EXPECT_EQ(service->counters().cancelled, 2U);
}

TEST_F(http_client, takes_nothing_more_in_callbacks_of_its_end) {
  const http_server server(hold);
  std::atomic<bool> was_refused{false};
  auto service = open(settings_for(server.url()));
  client* const raw = service.get();
  ASSERT_TRUE(service->send({}, [&](const result<response>&) {
    const auto again = raw->send({}, [](const result<response>&) { ADD_FAILURE() << "this must not be called"; });
    was_refused = !again && again.error().code == errc::closing;
  }));
  service.reset();
  EXPECT_TRUE(was_refused);
}

// What is sent by a callback lies on its way through the client's own thread, just where the end comes in.
TEST_F(http_client, calls_back_for_what_a_callback_sent_while_the_end_began) {
  const http_server server(say_ok);
  for (int i = 0; i < 20; ++i) {
    std::binary_semaphore has_sent{0};
    bool was_called = false;
    auto service = open(settings_for(server.url()));
    ASSERT_TRUE(service->send({}, [&, raw = service.get()](const result<response>&) {
      EXPECT_TRUE(raw->send({}, [&](const result<response>&) { was_called = true; }));
      has_sent.release();
      request impossible;
      impossible.target = "no path";
      while (raw->send(impossible, nullptr).error().code != errc::closing)
        std::this_thread::yield();
    }));
    has_sent.acquire();
    service.reset();
    EXPECT_TRUE(was_called);
  }
}

TEST_F(http_client, ends_while_connections_are_being_made) {
  for (int i = 0; i < 50; ++i) {
    const http_server server(say_ok, with_tls());
    endings seen;
    {
      const auto service = open(settings_for(server.url(i % 2 == 0 ? "127.0.0.1" : "localhost")));
      for (int n = 0; n < 4; ++n)
        ASSERT_TRUE(service->send({}, seen.next()));
    }
    EXPECT_EQ(seen.answered + seen.cancelled, 4);
  }
}

TEST_F(http_client, gives_a_large_body_to_the_sink_piece_by_piece) {
  const std::string piece(1024 * 1024, 'x');
  const http_server server([&](http_peer& peer, const http_request&) {
    peer.write("HTTP/1.1 200 OK\r\nContent-Length: 33554432\r\n\r\n");
    for (int i = 0; i < 32; ++i)
      peer.write(piece);
  });
  std::size_t taken = 0;
  std::size_t largest = 0;
  request asked;
  asked.max_body_bytes = 32 * piece.size();
  asked.on_body = [&](std::span<const std::byte> bytes) {
    taken += bytes.size();
    largest = std::max(largest, bytes.size());
    return body_flow::more;
  };
  const auto end = ask(server.url(), asked);
  ASSERT_TRUE(end) << end.error().message();
  EXPECT_EQ(end->body, "");
  EXPECT_EQ(end->body_bytes, 32 * piece.size());
  EXPECT_EQ(taken, 32 * piece.size());
  EXPECT_LE(largest, read_piece_bytes);
}

// The service is held up by a sink that pauses: what it can write until then is what the buffers of the system take.
TEST_F(http_client, reads_nothing_while_a_sink_has_asked_for_a_pause) {
  constexpr std::size_t all_bytes = 256 * 1024 * 1024;
  std::atomic<std::size_t> written{0};
  const http_server server([&](http_peer& peer, const http_request& which) {
    if (which.target() == "/small")
      return say_ok(peer, which);
    const std::string piece(64 * 1024, 'x');
    peer.write("HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(all_bytes) + "\r\n\r\n");
    while (written < all_bytes && peer.write(piece))
      written += piece.size();
  });
  const auto service = open(settings_for(server.url()));
  endings seen;
  std::binary_semaphore paused{0};
  std::atomic<std::size_t> taken{0};
  bool was_paused = false; // in the client's thread only
  request asked;
  asked.max_body_bytes = all_bytes;
  asked.on_body = [&](std::span<const std::byte> bytes) {
    taken += bytes.size();
    if (std::exchange(was_paused, true))
      return body_flow::more;
    paused.release();
    return body_flow::pause;
  };
  const auto sent = service->send(asked, seen.next());
  ASSERT_TRUE(sent);
  ASSERT_TRUE(paused.try_acquire_for(patience));
  EXPECT_TRUE(ask(*service, to("/small"))); // a pause holds up its own connection only
  EXPECT_LE(taken, 2 * read_piece_bytes);
  EXPECT_LT(written, all_bytes);
  service->resume(*sent);
  ASSERT_TRUE(seen.wait(1));
  EXPECT_EQ(seen.answered, 1);
  EXPECT_EQ(taken, all_bytes);
}

TEST_F(http_client, ends_as_cancelled_when_the_sink_wants_no_more) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write("HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\nbegin");
    peer.wait_until_gone();
  });
  request asked;
  asked.on_body = [](std::span<const std::byte>) { return body_flow::cancel; };
  EXPECT_EQ(code_of(ask(server.url(), asked)), errc::cancelled);
}

TEST_F(http_client, refuses_a_request_that_could_not_be_sent) {
  const auto service = open(settings_for("http://127.0.0.1:1"));
  const auto refused = service->send(to("no-slash"), [](const result<response>&) { ADD_FAILURE(); });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, errc::invalid_request);
}

TEST_F(http_client, is_not_opened_with_files_that_can_not_be_read) {
  auto wanted = settings_for("https://127.0.0.1");
  wanted.ca_file = store("ca.pem", "no certificate");
  EXPECT_EQ(client::open(wanted).error().code, errc::invalid_settings);
  wanted.ca_file = "/nowhere.pem";
  EXPECT_EQ(client::open(wanted).error().where, "/nowhere.pem");
  wanted = settings_for("https://127.0.0.1");
  wanted.certificate_file = store("own.pem", loopback_identity().certificate);
  wanted.key_file = store("own.key", loopback_identity().key, 0640);
  const auto readable_by_others = client::open(wanted);
  ASSERT_FALSE(readable_by_others);
  EXPECT_NE(readable_by_others.error().message().find("must be 0600"), std::string::npos);
  wanted.key_file = store("own.key", issuer().key); // of another certificate
  EXPECT_FALSE(client::open(wanted));
}

} // namespace client_test
} // namespace godwit::io::http::test
