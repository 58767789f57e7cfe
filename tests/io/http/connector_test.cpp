// The way to the service, above all through a proxy; how connecting fails is in exchange_test.cpp.
#include "io/http/connector.hpp"

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "tests/io/http/http_fixture.hpp"

namespace godwit::io::http::test {
namespace connector_test {

using godwit::test::make_tls_identity;
using http_connector_proxy = http_fixture;

// Lets through whoever asks, to the port that was asked for on this computer, and notes what it was told.
class test_proxy {
public:
  [[nodiscard]] std::string url() const { return server_.url(); }
  [[nodiscard]] std::vector<std::string> heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

private:
  void serve(http_peer& peer, const http_request& asked) {
    const std::string target(asked.target());
    {
      const std::lock_guard lock(mutex_);
      heard_.push_back(std::string(asked.method_string()) + " " + target + " " + std::string(asked["Authorization"]));
    }
    if (asked.method() != boost::beast::http::verb::connect)
      return static_cast<void>(peer.write(http_answer("200 OK", "through the proxy")));
    peer.write("HTTP/1.1 200 Connection established\r\n\r\n");
    peer.tunnel_to(static_cast<std::uint16_t>(std::stoul(target.substr(target.rfind(':') + 1))));
    peer.hang_up();
  }

  mutable std::mutex mutex_;
  std::vector<std::string> heard_; // under the mutex
  http_server server_{[this](http_peer& peer, const http_request& asked) { serve(peer, asked); }};
};

TEST_F(http_connector_proxy, is_asked_for_a_way_and_hears_nothing_of_the_token) {
  const http_server service(
      [](http_peer& peer, const http_request& asked) {
        peer.write(http_answer("200 OK", backwards(asked["Authorization"])));
      },
      with_tls());
  const test_proxy proxy;
  auto wanted = settings_for(service.url());
  wanted.proxy = proxy.url();
  wanted.token_file = store("token", "hunter2");
  const auto client = open(wanted);
  EXPECT_EQ(body_of(ask(*client, {})), backwards("Bearer hunter2"));
  EXPECT_EQ(body_of(ask(*client, {})), backwards("Bearer hunter2")); // through the same tunnel
  EXPECT_EQ(proxy.heard(), std::vector<std::string>{"CONNECT 127.0.0.1:" + std::to_string(service.port()) + " "});
}

TEST_F(http_connector_proxy, does_not_stand_in_for_the_service) {
  const auto other_issuer = make_tls_identity({.common_name = "another issuer", .is_issuer = true});
  godwit::test::http_server_options options;
  options.tls = make_tls_identity({.hosts = {"IP:127.0.0.1"}}, &other_issuer);
  const http_server in_between([](http_peer&, const http_request&) { ADD_FAILURE(); }, options);
  const test_proxy proxy;
  auto wanted = settings_for(in_between.url());
  wanted.proxy = proxy.url();
  EXPECT_EQ(code_of(ask(*open(wanted), {})), errc::tls_not_verified);
}

TEST_F(http_connector_proxy, is_given_the_whole_url_without_tls) {
  const test_proxy proxy;
  auto wanted = settings_for("http://missions.example/api");
  wanted.proxy = proxy.url();
  request asked;
  asked.target = "/missions/7";
  EXPECT_EQ(body_of(ask(*open(wanted), asked)), "through the proxy");
  EXPECT_EQ(proxy.heard(), std::vector<std::string>{"GET http://missions.example:80/api/missions/7 "});
}

TEST_F(http_connector_proxy, that_refuses_is_named_as_the_one_who_does) {
  const std::vector<std::pair<const char*, errc>> answers{{"407 Proxy Authentication Required", errc::proxy_refused},
                                                          {"403 Forbidden", errc::proxy_refused},
                                                          {"502 Bad Gateway", errc::unreachable}}; // try again later
  for (const auto& [status, code] : answers) {
    const std::string text = http_answer(status, "no, and a body to it");
    const http_server proxy([&text](http_peer& peer, const http_request&) { peer.write(text); });
    auto wanted = settings_for("https://missions.example");
    wanted.proxy = proxy.url();
    const auto end = ask(*open(wanted), {});
    EXPECT_EQ(code_of(end), code) << status;
    EXPECT_NE(end.error().message().find("the proxy does not let us through"), std::string::npos);
  }
}

TEST_F(http_connector_proxy, that_says_nothing_is_waited_for_no_longer_than_for_a_connection) {
  const http_server proxy([](http_peer& peer, const http_request&) { peer.wait_until_gone(); });
  auto wanted = settings_for("https://missions.example");
  wanted.proxy = proxy.url();
  wanted.connect_timeout = std::chrono::milliseconds(200);
  const auto end = ask(*open(wanted), {});
  EXPECT_EQ(code_of(end), errc::connect_timeout);
  EXPECT_NE(end.error().message().find("waiting for the proxy"), std::string::npos);
}

TEST_F(http_connector_proxy, that_speaks_before_tls_begins_is_not_trusted) {
  const http_server proxy([](http_peer& peer, const http_request&) {
    peer.write("HTTP/1.1 200 OK\r\n\r\nbytes that nobody asked for");
    peer.wait_until_gone();
  });
  auto wanted = settings_for("https://missions.example");
  wanted.proxy = proxy.url();
  EXPECT_EQ(code_of(ask(*open(wanted), {})), errc::proxy_refused);
}

} // namespace connector_test
} // namespace godwit::io::http::test
