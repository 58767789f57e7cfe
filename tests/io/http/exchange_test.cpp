// What comes of a request when the service, or the way to it, fails: one test for each fault.
#include "io/http/exchange.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "io/http/outcome.hpp"
#include "io/http/request_head.hpp"
#include "tests/io/http/http_fixture.hpp"

namespace godwit::io::http::test {
namespace exchange_test {

using namespace std::chrono_literals;
using http_exchange_when = http_fixture;

constexpr auto short_time = 200ms; // for the time-out that a test is about

request request_to(std::string target) {
  request asked;
  asked.target = std::move(target);
  return asked;
}

request post(std::string key) {
  request asked;
  asked.method = method::post;
  asked.body = "{}";
  asked.idempotency_key = std::move(key);
  return asked;
}

// A port of 127.0.0.1 on which nobody listens: it is bound, so that nobody else takes it.
class deaf_port {
public:
  deaf_port() : socket_(io_, {boost::asio::ip::address_v4::loopback(), 0}) {}
  [[nodiscard]] std::string url() const {
    return "http://127.0.0.1:" + std::to_string(socket_.local_endpoint().port());
  }

private:
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_;
};

TEST_F(http_exchange_when, nobody_listens) {
  const deaf_port nobody;
  const auto end = ask(nobody.url(), request_to("/missions/7?token=hunter2"));
  EXPECT_EQ(code_of(end), errc::refused);
  EXPECT_TRUE(is_transient(end.error().code));
  EXPECT_EQ(end.error().where, nobody.url() + "/missions/7"); // without the query
  EXPECT_NE(end.error().message().find("nobody listens there"), std::string::npos);
}

TEST_F(http_exchange_when, the_host_has_no_address) {
  const auto end = ask("http://no-such-host.invalid", {});
  EXPECT_EQ(code_of(end), errc::cannot_resolve);
  EXPECT_NE(end.error().message().find("no-such-host.invalid"), std::string::npos);
}

TEST_F(http_exchange_when, the_service_accepts_and_never_begins_tls) {
  // A listener that accepts nothing: the system completes the connection, and nobody ever speaks.
  boost::asio::io_context io;
  const boost::asio::ip::tcp::acceptor silent(io, {boost::asio::ip::address_v4::loopback(), 0});
  auto wanted = settings_for("https://127.0.0.1:" + std::to_string(silent.local_endpoint().port()));
  wanted.connect_timeout = short_time;
  const auto end = ask(*open(wanted), {});
  EXPECT_EQ(code_of(end), errc::connect_timeout);
  EXPECT_NE(end.error().message().find("waiting for TLS"), std::string::npos);
}

TEST_F(http_exchange_when, the_service_takes_the_request_and_says_nothing) {
  const http_server server([](http_peer& peer, const http_request&) { peer.wait_until_gone(); });
  auto wanted = settings_for(server.url());
  wanted.read_timeout = short_time;
  const auto service = open(wanted);
  EXPECT_EQ(code_of(ask(*service, {})), errc::read_timeout);
  request patient;
  patient.read_timeout = 2 * short_time; // each request may say otherwise
  const auto end = ask(*service, patient);
  EXPECT_EQ(code_of(end), errc::read_timeout);
  EXPECT_NE(end.error().message().find("no byte in 0.4 s"), std::string::npos) << end.error().message();
  EXPECT_EQ(service->counters().timed_out, 2U);
}

TEST_F(http_exchange_when, the_service_says_a_byte_now_and_then) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write("HTTP/1.1 200 OK\r\nContent-Length: 1000000\r\n\r\n");
    while (peer.write("."))
      std::this_thread::sleep_for(1ms); // a slow service: nothing waits for the end of this
  });
  auto wanted = settings_for(server.url());
  wanted.total_timeout = short_time;
  const auto end = ask(*open(wanted), {});
  EXPECT_EQ(code_of(end), errc::total_timeout);
  EXPECT_NE(end.error().message().find("waiting for the answer"), std::string::npos);
}

TEST_F(http_exchange_when, others_hold_all_connections_until_it_is_too_late) {
  const http_server server([](http_peer& peer, const http_request&) { peer.wait_until_gone(); });
  auto wanted = settings_for(server.url());
  wanted.max_under_way = 1;
  const auto service = open(wanted);
  ASSERT_TRUE(service->send({}, [](const result<response>&) {}));
  request asked;
  asked.total_timeout = short_time;
  const auto end = ask(*service, asked);
  EXPECT_EQ(code_of(end), errc::total_timeout);
  EXPECT_NE(end.error().message().find("waiting for a free connection"), std::string::npos);
}

TEST_F(http_exchange_when, the_connection_is_reset_before_an_answer) {
  const http_server server([](http_peer& peer, const http_request&) { peer.reset(); });
  EXPECT_EQ(code_of(ask(server.url(), post("key"))), errc::connection_lost);
  EXPECT_EQ(server.requests(), 1); // it was no kept connection, so it is for the caller to try again
}

TEST_F(http_exchange_when, the_connection_is_reset_in_the_middle_of_the_body) {
  const http_server server(
      [](http_peer& peer, const http_request&) {
        peer.write("HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\nbegin");
        peer.reset();
      },
      with_tls());
  // The reset may overtake the bytes before it.
  const auto code = code_of(ask(server.url(), {}));
  EXPECT_TRUE(code == errc::truncated || code == errc::connection_lost) << name_of(code);
}

TEST_F(http_exchange_when, the_answer_is_closed_in_the_middle) {
  const http_server server([](http_peer& peer, const http_request& asked) {
    peer.write(asked.target() == "/chunked" ? "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nbe"
                                            : "HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\nbegin");
    peer.close();
  });
  const auto end = ask(server.url(), {});
  EXPECT_EQ(code_of(end), errc::truncated);
  EXPECT_TRUE(is_transient(end.error().code));
  EXPECT_EQ(code_of(ask(server.url(), request_to("/chunked"))), errc::truncated);
}

TEST_F(http_exchange_when, a_body_without_a_length_ends_without_a_word_of_tls) {
  const auto answer = [](bool says_so) {
    return [says_so](http_peer& peer, const http_request&) {
      peer.write("HTTP/1.1 200 OK\r\n\r\nall of it?");
      says_so ? peer.close() : peer.hang_up();
    };
  };
  const http_server polite(answer(true), with_tls());
  EXPECT_EQ(body_of(ask(polite.url(), {})), "all of it?");
  const http_server rude(answer(false), with_tls());
  EXPECT_EQ(code_of(ask(rude.url(), {})), errc::truncated);
}

TEST_F(http_exchange_when, the_service_is_busy_and_says_until_when) {
  const http_server server([](http_peer& peer, const http_request& asked) {
    peer.write(http_answer(asked.target() == "/429" ? "429 Too Many Requests" : "503 Service Unavailable", "later",
                           "Retry-After: 17\r\n"));
  });
  for (const auto* target : {"/429", "/503"}) {
    const auto end = ask(server.url(), request_to(target));
    ASSERT_TRUE(end);
    EXPECT_EQ(outcome_of(end->status), outcome::transient);
    EXPECT_EQ(retry_after(*end, std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now())), 17s);
  }
}

TEST_F(http_exchange_when, the_service_is_elsewhere) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write(http_answer("307 Temporary Redirect", "", "Location: https://elsewhere.example/x\r\n"));
  });
  const auto end = ask(server.url(), {});
  EXPECT_EQ(code_of(end), errc::redirect);
  EXPECT_NE(end.error().message().find("https://elsewhere.example/x"), std::string::npos);
  EXPECT_EQ(server.requests(), 1);
}

TEST_F(http_exchange_when, something_else_answers_with_a_page) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write(http_answer("200 OK", "<html>log in</html>", "Content-Type: text/html\r\n"));
  });
  request asked;
  asked.expected_content_type = "application/json";
  asked.on_body = [](std::span<const std::byte>) {
    ADD_FAILURE() << "nothing of it may reach the sink";
    return body_flow::more;
  };
  EXPECT_EQ(code_of(ask(server.url(), asked)), errc::wrong_content_type);
}

// The page is never read as a whole: the memory for it is bounded by what the request expects.
TEST_F(http_exchange_when, the_body_has_a_gigabyte) {
  std::atomic<std::size_t> written{0};
  const http_server server([&](http_peer& peer, const http_request& asked) {
    const std::string piece(64 * 1024, 'x');
    peer.write(asked.target() == "/announced" ? "HTTP/1.1 200 OK\r\nContent-Length: 1073741824\r\n\r\n"
                                              : "HTTP/1.1 200 OK\r\n\r\n");
    while (written < 1024U * 1024U * 1024U && peer.write(piece))
      written += piece.size();
  });
  EXPECT_EQ(code_of(ask(server.url(), request_to("/announced"))), errc::body_too_large);
  EXPECT_EQ(code_of(ask(server.url(), request_to("/endless"))), errc::body_too_large);
  EXPECT_LT(written, 128U * 1024U * 1024U); // what the buffers of the system take
}

TEST_F(http_exchange_when, the_head_never_ends) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write("HTTP/1.1 200 OK\r\n");
    while (peer.write("X-Bomb: ................................\r\n")) {
    }
  });
  EXPECT_EQ(code_of(ask(server.url(), {})), errc::header_too_large);
}

TEST_F(http_exchange_when, the_service_speaks_something_else) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write("220 mail.example ESMTP\r\n");
    peer.wait_until_gone();
  });
  EXPECT_EQ(code_of(ask(server.url(), {})), errc::malformed);
}

TEST_F(http_exchange_when, a_kept_connection_was_closed_in_between) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write(http_answer("200 OK", "ok"));
    peer.close();
  });
  const auto service = open(settings_for(server.url()));
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(body_of(ask(*service, post("key"))), "ok"); // whether that is seen in time or not
  EXPECT_EQ(server.connections(), 5);
}

// Dead, but not known to be so when the request was sent.
TEST_F(http_exchange_when, a_kept_connection_dies_under_the_next_request) {
  const http_server server([](http_peer& peer, const http_request&) {
    if (peer.request == 1)
      peer.write(http_answer("200 OK", std::to_string(peer.connection)));
    else
      peer.reset();
  });
  const auto service = open(settings_for(server.url()));
  EXPECT_EQ(body_of(ask(*service, {})), "1");
  EXPECT_EQ(body_of(ask(*service, {})), "2"); // a GET
  EXPECT_EQ(body_of(ask(*service, post("key"))), "3");
  EXPECT_EQ(service->counters().repeated, 2U);
  EXPECT_EQ(code_of(ask(*service, post(""))), errc::connection_lost); // it may have been carried out
  EXPECT_EQ(service->counters().repeated, 2U);
}

TEST_F(http_exchange_when, a_kept_connection_dies_and_so_does_the_next_one) {
  const http_server server([](http_peer& peer, const http_request&) {
    if (peer.connection == 1 && peer.request == 1)
      peer.write(http_answer("200 OK", "ok"));
    else
      peer.reset();
  });
  const auto service = open(settings_for(server.url()));
  ASSERT_TRUE(ask(*service, {}));
  EXPECT_EQ(code_of(ask(*service, {})), errc::connection_lost);
  EXPECT_EQ(server.requests(), 3); // repeated once, not for ever
}

TEST_F(http_exchange_when, a_kept_connection_dies_in_the_middle_of_an_answer) {
  const http_server server([](http_peer& peer, const http_request&) {
    if (peer.request == 1)
      return static_cast<void>(peer.write(http_answer("200 OK", "ok")));
    peer.write("HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\npart");
    peer.close();
  });
  const auto service = open(settings_for(server.url()));
  ASSERT_TRUE(ask(*service, {}));
  EXPECT_EQ(code_of(ask(*service, {})), errc::truncated); // the service has acted: not repeated
  EXPECT_EQ(server.requests(), 2);
}

TEST_F(http_exchange_when, the_service_answers_before_it_has_read_everything) {
  const http_server server([](http_peer& peer, const http_request&) {
    peer.write(http_answer("413 Content Too Large", "too much", "Connection: close\r\n"));
    peer.close();
  });
  auto asked = post("key");
  asked.body.assign(2 * 1024 * 1024, 'x'); // more than sockets hold
  const auto end = ask(server.url(), asked);
  ASSERT_TRUE(end) << end.error().message();
  EXPECT_EQ(end->status, 413U);
}

} // namespace exchange_test
} // namespace godwit::io::http::test
