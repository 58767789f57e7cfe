// Whom the client trusts, and what it says about those whom it does not.
#include "io/http/tls.hpp"

#include <string>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include "tests/io/http/http_fixture.hpp"

namespace godwit::io::http::test {
namespace tls_test {

using godwit::test::certificate_request;
using godwit::test::http_server_options;
using godwit::test::make_tls_identity;
using http_tls = http_fixture;

void answer_ok(http_peer& peer, const http_request&) { peer.write(http_answer("200 OK", "ok")); }

http_server_options identified_by(const godwit::test::tls_identity& identity) {
  http_server_options options;
  options.tls = identity;
  return options;
}

TEST_F(http_tls, trusts_nobody_whom_its_ca_file_does_not_name) {
  const auto other_issuer = make_tls_identity({.common_name = "another issuer", .is_issuer = true});
  const http_server server(answer_ok, identified_by(make_tls_identity({.hosts = {"IP:127.0.0.1"}}, &other_issuer)));
  const auto end = ask(server.url(), {});
  EXPECT_EQ(code_of(end), errc::tls_not_verified);
  EXPECT_NE(end.error().message().find("127.0.0.1"), std::string::npos);
  EXPECT_NE(end.error().message().find("issuer"), std::string::npos);
  EXPECT_EQ(server.requests(), 0);
}

TEST_F(http_tls, does_not_trust_a_certificate_that_signs_itself) {
  const http_server server(answer_ok, identified_by(make_tls_identity({.hosts = {"IP:127.0.0.1"}})));
  const auto end = ask(server.url(), {});
  EXPECT_EQ(code_of(end), errc::tls_not_verified);
  EXPECT_NE(end.error().message().find("self-signed"), std::string::npos) << end.error().message();
  EXPECT_NE(end.error().message().find("CA file"), std::string::npos);
}

TEST_F(http_tls, trusts_a_certificate_that_signs_itself_when_it_is_the_ca_file) {
  const auto own = make_tls_identity({.hosts = {"IP:127.0.0.1"}});
  const http_server server(answer_ok, identified_by(own));
  auto wanted = settings_for(server.url());
  wanted.ca_file = store("own.pem", own.certificate);
  EXPECT_TRUE(ask(*open(wanted), {}));
}

TEST_F(http_tls, trusts_none_but_the_issuers_of_the_system_without_a_ca_file) {
  const http_server server(answer_ok, with_tls());
  auto wanted = settings_for(server.url());
  wanted.ca_file = "";
  EXPECT_EQ(code_of(ask(*open(wanted), {})), errc::tls_not_verified);
}

TEST_F(http_tls, refuses_the_certificate_of_another_host) {
  const http_server server(answer_ok,
                           identified_by(make_tls_identity({.hosts = {"DNS:elsewhere.example"}}, &issuer())));
  for (const auto* host : {"127.0.0.1", "localhost"}) {
    const auto end = ask(server.url(host), {});
    EXPECT_EQ(code_of(end), errc::wrong_host);
    EXPECT_NE(end.error().message().find(std::string("not that of ") + host), std::string::npos);
  }
  EXPECT_EQ(server.requests(), 0);
}

TEST_F(http_tls, looks_for_the_host_in_the_alternative_names_of_its_kind) {
  const http_server by_name(answer_ok, identified_by(make_tls_identity({.hosts = {"DNS:127.0.0.1"}}, &issuer())));
  EXPECT_EQ(code_of(ask(by_name.url(), {})), errc::wrong_host); // an address is no name
  const http_server by_subject(
      answer_ok, identified_by(make_tls_identity({.common_name = "127.0.0.1", .hosts = {"DNS:a"}}, &issuer())));
  EXPECT_EQ(code_of(ask(by_subject.url(), {})), errc::wrong_host);
  const http_server without(answer_ok, identified_by(make_tls_identity({.common_name = "localhost"}, &issuer())));
  EXPECT_EQ(code_of(ask(without.url("localhost"), {})), errc::wrong_host); // the common name is no name of a host
}

TEST_F(http_tls, refuses_what_has_expired_and_what_is_not_valid_yet) {
  for (const auto& [begins_s, ends_s] : {std::pair{-7200L, -3600L}, std::pair{3600L, 7200L}}) {
    const certificate_request wanted{
        .common_name = "a", .hosts = {"IP:127.0.0.1"}, .begins_s = begins_s, .ends_s = ends_s};
    const http_server server(answer_ok, identified_by(make_tls_identity(wanted, &issuer())));
    const auto end = ask(server.url(), {});
    EXPECT_EQ(code_of(end), errc::tls_not_verified);
    EXPECT_NE(end.error().message().find("is the clock of this computer right?"), std::string::npos);
  }
}

TEST_F(http_tls, speaks_1_2_and_nothing_older) {
  auto options = with_tls();
  options.max_tls_version = TLS1_2_VERSION;
  const http_server current(answer_ok, options);
  EXPECT_TRUE(ask(current.url(), {}));
  options.max_tls_version = TLS1_1_VERSION;
  const http_server old(answer_ok, options);
  const auto end = ask(old.url(), {});
  EXPECT_EQ(code_of(end), errc::tls_failed);
  EXPECT_NE(end.error().message().find("no TLS 1.2 or newer"), std::string::npos) << end.error().message();
}

TEST_F(http_tls, says_when_the_port_speaks_no_tls) {
  namespace ip = boost::asio::ip;
  boost::asio::io_context io;
  ip::tcp::acceptor listener(io, {ip::address_v4::loopback(), 0});
  const std::jthread plain([&] {
    auto peer = listener.accept();
    boost::asio::write(peer, boost::asio::buffer("HTTP/1.1 400 Bad Request\r\n\r\n", 28));
    char byte = 0;
    while (::recv(peer.native_handle(), &byte, 1, 0) > 0) { // until the client has gone
    }
  });
  auto wanted = settings_for("https://127.0.0.1:" + std::to_string(listener.local_endpoint().port()));
  const auto end = ask(*open(wanted), {});
  EXPECT_EQ(code_of(end), errc::tls_failed);
  EXPECT_NE(end.error().message().find("is this a port for http://?"), std::string::npos) << end.error().message();
}

TEST_F(http_tls, shows_its_certificate_to_a_service_that_asks_for_one) {
  auto options = with_tls();
  options.client_issuer = issuer().certificate;
  for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) { // which refuse at different moments
    options.max_tls_version = version;
    const http_server server(answer_ok, options);
    auto wanted = settings_for(server.url());
    EXPECT_EQ(code_of(ask(*open(wanted), {})), errc::tls_failed);
    EXPECT_EQ(server.requests(), 0);
    const auto ours = make_tls_identity({.common_name = "vehicle 7"}, &issuer());
    wanted.certificate_file = store("own.pem", ours.certificate);
    wanted.key_file = store("own.key", ours.key);
    EXPECT_TRUE(ask(*open(wanted), {}));
    const auto stranger = make_tls_identity({.common_name = "vehicle 8"});
    wanted.certificate_file = store("own.pem", stranger.certificate);
    wanted.key_file = store("own.key", stranger.key);
    EXPECT_EQ(code_of(ask(*open(wanted), {})), errc::tls_failed);
  }
}

} // namespace tls_test
} // namespace godwit::io::http::test
