// Listening, letting in, TLS and shutting down; what happens in a connection is in session_test.cpp.
#include "io/http/server/server.hpp"

#include <future>
#include <list>
#include <optional>
#include <utility>

#include <openssl/ssl.h>

#include "io/http/tls.hpp"
#include "tests/io/http/http_fixture.hpp"
#include "tests/io/http/server/server_fixture.hpp"

namespace godwit::io::http::test {
namespace server_test {

using http_server_tls = http_fixture;

tls_context server_tls(const godwit::test::tls_identity& who) {
  return make_server_tls_context(who.certificate, who.key).value();
}

TEST(http_server_listens, and_a_port_that_is_taken_is_named_with_the_remedy) {
  running_server first;
  boost::asio::io_context io;
  server second(io, {.port = first.port()}, {.handle = say_target});
  const auto listening = second.listen();
  ASSERT_FALSE(listening);
  EXPECT_EQ(listening.error().code, errc::cannot_listen);
  EXPECT_EQ(listening.error().where, "127.0.0.1:" + std::to_string(first.port()));
  EXPECT_NE(listening.error().what.find("another program listens there"), std::string::npos);
}

TEST(http_server_listens, only_where_this_computer_is) {
  boost::asio::io_context io;
  for (const auto* host : {"192.0.2.1", "no such host"}) {
    server nowhere(io, {.host = host}, {.handle = say_target});
    const auto listening = nowhere.listen();
    ASSERT_FALSE(listening) << host;
    EXPECT_EQ(listening.error().code, errc::cannot_listen);
  }
}

TEST(http_server_listens, on_loopback_unless_it_is_told_otherwise) {
  running_server server;
  server.inside([&](const auto& it) { EXPECT_EQ(it.place(), "127.0.0.1:" + std::to_string(server.port())); });
}

TEST(http_server_listens, again_at_the_port_of_the_first_time) {
  running_server server;
  raw_client before(server);
  before.write(get("/a"));
  EXPECT_EQ(before.read().body(), "/a");
  server.inside([](auto& it) {
    it.stop_listening();
    it.end_connections();
  });
  EXPECT_EQ(before.read_to_end(), "");
  EXPECT_THROW(raw_client{server}, boost::system::system_error); // nobody listens
  server.inside([&](auto& it) {
    EXPECT_TRUE(it.listen());
    EXPECT_TRUE(it.listen()); // as it does already
    EXPECT_EQ(it.port(), server.port());
  });
  raw_client after(server);
  after.write(get("/b"));
  EXPECT_EQ(after.read().body(), "/b");
}

TEST(http_server_bounds, max_connections_are_let_in_and_the_next_is_closed) {
  running_server server(say_target, {.max_connections = 2});
  std::list<raw_client> two;
  two.emplace_back(server);
  two.emplace_back(server);
  EXPECT_EQ(raw_client(server).read_to_end(), "");
  EXPECT_EQ(server.counters().turned_away, 1U);
  two.pop_back();
  ASSERT_TRUE(server.reaches(&server_counters::open, 1));
  raw_client next(server);
  next.write(get("/a"));
  EXPECT_EQ(next.read().body(), "/a");
}

TEST(http_server_shuts_down, when_the_answers_under_way_have_gone_out) {
  std::optional<responder> held;
  running_server server([&](auto, responder answer) { held.emplace(std::move(answer)); });
  raw_client idle(server);
  raw_client asking(server);
  asking.write(get("/"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  std::promise<void> done;
  server.inside([&](auto& it) { it.shut_down(long_time, [&] { done.set_value(); }); });
  EXPECT_EQ(idle.read_to_end(), "");
  server.inside([&](auto&) { held->send({.body = "the last"}); });
  EXPECT_TRUE(asking.read_to_end().ends_with("\r\n\r\nthe last"));
  idle.close();
  asking.close();
  EXPECT_EQ(done.get_future().wait_for(long_time), std::future_status::ready);
}

TEST(http_server_shuts_down, and_may_be_destroyed_by_who_hears_of_it) {
  running_server server;
  std::promise<void> done;
  server.inside([&](auto& it) {
    it.shut_down(long_time, [&] {
      server.destroy_inside();
      done.set_value();
    });
  });
  EXPECT_EQ(done.get_future().wait_for(long_time), std::future_status::ready);
}

TEST(http_server_shuts_down, when_the_grace_is_over_all_the_same) {
  std::optional<responder> held;
  running_server server([&](auto, responder answer) { held.emplace(std::move(answer)); });
  raw_client asking(server);
  asking.write(get("/"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  std::promise<void> done;
  server.inside([&](auto& it) { it.shut_down(short_time, [&] { done.set_value(); }); });
  EXPECT_EQ(done.get_future().wait_for(long_time), std::future_status::ready);
  EXPECT_EQ(asking.read_to_end(), "");
}

TEST_F(http_server_tls, answers_the_client_of_this_folder) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  running_server server(say_target, {}, {.tls = [&] { return tls; }});
  const auto service = open(settings_for("https://localhost:" + std::to_string(server.port())));
  for (const std::string target : {"/a", "/b"}) {
    request asked;
    asked.target = target;
    EXPECT_EQ(body_of(ask(*service, asked)), target);
  }
  EXPECT_EQ(server.counters().accepted, 1U); // it was kept
}

TEST_F(http_server_tls, holds_an_answer_as_the_last_of_its_connection) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  std::optional<responder> held;
  running_server server([&](auto, responder answer) { held.emplace(std::move(answer)); }, {.max_requests = 1},
                        {.tls = [&] { return tls; }});
  const auto service = open(settings_for("https://localhost:" + std::to_string(server.port())));
  for (std::uint64_t n = 1; n <= 2; ++n) {
    auto answer = std::async(std::launch::async, [&] { return body_of(ask(*service, {})); });
    ASSERT_TRUE(server.reaches(&server_counters::requests, n));
    server.inside([&](auto&) { held->send({.body = "late"}); });
    EXPECT_EQ(answer.get(), "late");
  }
  EXPECT_TRUE(server.reaches(&server_counters::open, 0));
}

TEST(http_server, who_has_to_give_way_is_closed_while_it_says_nothing_and_while_it_waits_for_its_answer) {
  std::vector<std::shared_ptr<client_place>> places;
  std::optional<responder> kept; // and never answered
  running_server server([&](server_request, responder answer) { kept.emplace(std::move(answer)); }, {},
                        {.admit = [&](const auto&) { return places.emplace_back(std::make_shared<client_place>()); }});
  raw_client silent(server);
  raw_client waiting(server);
  waiting.write(get("/"));
  ASSERT_TRUE(server.reaches(&server_counters::requests, 1));
  ASSERT_TRUE(server.reaches(&server_counters::open, 2));
  server.inside([&](auto&) {
    for (const auto& each : places)
      each->end_connection();
  });
  EXPECT_EQ(silent.read_to_end(), "");
  EXPECT_EQ(waiting.read_to_end(), "");
  EXPECT_TRUE(server.reaches(&server_counters::open, 0));
  server.inside([&](auto&) {
    for (const auto& each : places)
      EXPECT_EQ(each->end_connection, nullptr) << "nobody is left to end";
    kept.reset();
  });
}

TEST_F(http_server_tls, has_no_cipher_suite_of_cbc) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  const auto* const suites = ::SSL_CTX_get_ciphers(tls->native_handle());
  ASSERT_GT(sk_SSL_CIPHER_num(suites), 0);
  for (int i = 0; i < sk_SSL_CIPHER_num(suites); ++i)
    EXPECT_TRUE(::SSL_CIPHER_is_aead(sk_SSL_CIPHER_value(suites, i)))
        << ::SSL_CIPHER_get_name(sk_SSL_CIPHER_value(suites, i));
}

TEST_F(http_server_tls, uses_another_certificate_for_the_next_connection) {
  const std::shared_ptr good = server_tls(loopback_identity());
  const std::shared_ptr other = server_tls(godwit::test::make_tls_identity({.hosts = {"DNS:elsewhere"}}, &issuer()));
  bool is_other = true;
  running_server server(say_target, {}, {.tls = [&] { return is_other ? other : good; }});
  const auto url = "https://127.0.0.1:" + std::to_string(server.port());
  EXPECT_EQ(code_of(ask(url)), errc::wrong_host);
  server.inside([&](auto&) { is_other = false; });
  EXPECT_EQ(body_of(ask(url)), "/");
}

TEST_F(http_server_tls, counts_who_refuses_its_certificate_and_who_speaks_none) {
  const std::shared_ptr tls = server_tls(godwit::test::make_tls_identity({.hosts = {"IP:127.0.0.1"}})); // signs itself
  running_server server(say_target, {}, {.tls = [&] { return tls; }});
  EXPECT_EQ(code_of(ask("https://127.0.0.1:" + std::to_string(server.port()))), errc::tls_not_verified);
  EXPECT_TRUE(server.reaches(&server_counters::handshakes_failed, 1));
  raw_client plain(server);
  plain.write(get("/"));
  const auto told = plain.read_to_end();
  EXPECT_TRUE(told.starts_with("HTTP/1.1 400 Bad Request\r\n")) << told;
  EXPECT_NE(told.find("ask with https://"), std::string::npos) << told;
  EXPECT_TRUE(server.reaches(&server_counters::handshakes_failed, 2));
  EXPECT_EQ(server.counters().requests, 0U);
  EXPECT_TRUE(server.reaches(&server_counters::open, 0));
}

TEST_F(http_server_tls, handshake_timeout_ends_who_says_nothing) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  running_server server(say_target, {.handshake_timeout = short_time}, {.tls = [&] { return tls; }});
  EXPECT_EQ(raw_client(server).read_to_end(), "");
  EXPECT_EQ(server.counters().handshake_timeouts, 1U);
}

// The beginning of a TLS 1.2 ClientHello that promises more than it says.
const std::string half_hello("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);

TEST_F(http_server_tls, ends_who_begins_a_handshake_and_stops_or_goes_on_a_byte_now_and_then) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  running_server server(say_target, {.handshake_timeout = short_time}, {.tls = [&] { return tls; }});
  raw_client half(server);
  half.write(half_hello);
  EXPECT_EQ(half.read_to_end(), "");
  raw_client slow(server);
  slow.write(half_hello);
  EXPECT_TRUE(slow.dribble_until_closed());
  EXPECT_TRUE(server.reaches(&server_counters::handshake_timeouts, 2));
  EXPECT_EQ(server.counters().handshakes, 0U);
  EXPECT_TRUE(server.reaches(&server_counters::open, 0));
}

TEST_F(http_server_tls, ends_who_says_what_is_no_tls_and_goes_on_with_others) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  running_server server(say_target, {.handshake_timeout = long_time}, {.tls = [&] { return tls; }});
  std::uint64_t failed = 0;
  for (const auto& garbage : {std::string("\x00\x00\x00\x00\x00\x00", 6), std::string(20'000, 'x'),
                              half_hello + std::string(600, '\xff'), std::string("\x15\x03\x03\x00\x02\x02\x28", 7),
                              std::string("\x80\x2e\x01\x00\x02", 5) + std::string(50, '\0')}) {
    raw_client client(server);
    client.write(garbage);
    client.close_sending();
    (void)client.read_to_end();
    EXPECT_TRUE(server.reaches(&server_counters::handshakes_failed, ++failed));
  }
  EXPECT_EQ(body_of(ask("https://127.0.0.1:" + std::to_string(server.port()))), "/");
  EXPECT_EQ(server.counters().handshakes, 1U);
}

TEST_F(http_server_tls, speaks_nothing_older_than_1_2) {
  const std::shared_ptr tls = server_tls(loopback_identity());
  EXPECT_EQ(::SSL_CTX_get_min_proto_version(tls->native_handle()), TLS1_2_VERSION);
}

TEST_F(http_server_tls, needs_a_certificate_and_the_key_that_fits_it) {
  const auto& who = loopback_identity();
  const auto none = make_server_tls_context("no PEM", who.key);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().where, "certificate of the server");
  for (const auto& key : {std::string("no PEM"), issuer().key}) {
    const auto wrong = make_server_tls_context(who.certificate, key);
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().where, "key of the server");
  }
}

} // namespace server_test
} // namespace godwit::io::http::test
