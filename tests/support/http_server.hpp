// A server for tests that says, byte for byte, what its handler wants, on 127.0.0.1 and a free port.
//
// Every connection has a thread of its own, so a handler may block: it serves one request after the other, and what it
// does badly is up to it. When the server ends it cuts all connections, and every blocking call of a handler returns.
//
// Errors: a server that can not listen throws. Thread: the handler is called in those of the connections, several at a
// time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "tests/support/tls_identity.hpp"

namespace godwit::test {

using http_request = boost::beast::http::request<boost::beast::http::string_body>;

// The server's end of one connection.
class http_peer {
public:
  virtual ~http_peer() = default;
  // False: the other side is gone.
  virtual bool write(std::string_view bytes) = 0;
  virtual void close() = 0;                       // as one should: with TLS, saying so
  virtual void hang_up() = 0;                     // closes TCP without a word of TLS
  virtual void reset() = 0;                       // a TCP reset
  virtual void wait_until_gone() = 0;             // says nothing until the other side closes
  virtual void tunnel_to(std::uint16_t port) = 0; // what a proxy does after CONNECT; plain TCP only

  int connection = 0; // counts from 1 in each server
  int request = 0;    // counts from 1 in each connection
};

struct http_server_options {
  std::optional<tls_identity> tls; // none: plain HTTP
  std::string client_issuer;       // PEM; not empty: asks for a client certificate of this issuer
  int max_tls_version = 0;         // TLS1_1_VERSION ...; 0: the newest
};

class http_server {
public:
  using handler = std::function<void(http_peer& peer, const http_request& asked)>;

  explicit http_server(handler answer, const http_server_options& options = {});
  ~http_server();
  http_server(const http_server&) = delete;
  http_server& operator=(const http_server&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  // "http://127.0.0.1:PORT" or https
  [[nodiscard]] std::string url(const std::string& host = "127.0.0.1") const;
  [[nodiscard]] int connections() const; // accepted so far
  [[nodiscard]] int requests() const;    // read so far

private:
  class running;
  std::unique_ptr<running> running_;
};

// "HTTP/1.1 200 OK" with Content-Length. HEADERS: whole lines, each with its line end.
[[nodiscard]] std::string http_answer(std::string_view status, std::string_view body, std::string_view headers = {});

} // namespace godwit::test
