// A server of HTTP/1.1 over TLS or without it, with a bound on everything that strangers can ask of it.
//
//   server pages(thread.context(), {.port = 8080}, {.handle = [](server_request asked, responder answer) { ... }});
//   if (const auto listening = pages.listen(); !listening) ...
//
// It lives in a context that somebody else runs (io/link/io_thread.hpp, or a test by hand). What the handler is given
// is complete and within the bounds of the settings; who may ask what, which Host and Origin are its own, and what
// there is at a path, are the business of the handler.
//
// Errors: as values; what clients do wrong is answered, counted and never an error. An exception out of a handler is a
// broken invariant and ends the process. Thread: that of the context, for all; or any while nobody runs it.
// Source: RFC 9110, RFC 9112; HTTP/1.0 is answered, one request a connection.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ssl/context.hpp>

#include "io/http/connection.hpp"
#include "io/http/error.hpp"
#include "io/http/server/request_reader.hpp"
#include "io/http/server/responder.hpp"
#include "io/http/server/settings.hpp"

namespace godwit::io::http {

struct server_hooks {
  // Called for each request, in the order of its connection.
  std::function<void(server_request asked, responder answer)> handle = {};
  body_limit max_body_bytes = {};
  // Asked for each connection, so that a certificate can be exchanged while the server runs: a connection keeps what it
  // was given. None: plain HTTP.
  std::function<std::shared_ptr<boost::asio::ssl::context>()> tls = {};
  // Asked for each connection, by the address that it comes from. What it gives stays with the connection, also when
  // somebody else takes that over; null: it is turned away. None: all are let in, up to max_connections.
  std::function<std::shared_ptr<client_place>(const boost::asio::ip::address& from)> admit = {};
};

class server {
public:
  static constexpr std::chrono::milliseconds accept_pause{100}; // when the system has no descriptor left

  server(boost::asio::io_context& io, server_settings set, server_hooks hooks);
  ~server(); // as stop_listening and end_connections
  server(const server&) = delete;
  server& operator=(const server&) = delete;

  // Blocks on looking up the host. Again: at the place of the first time. Nothing happens while it listens.
  [[nodiscard]] result<void> listen();
  void stop_listening();
  void end_connections();
  // Stops listening, lets the answers that are under way go out, at most for GRACE, and ends all connections.
  void shut_down(std::chrono::milliseconds grace, std::function<void()> then);

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::string place() const; // "127.0.0.1:8080", "[::1]:8080"
  [[nodiscard]] server_counters counters() const;

private:
  class engine;
  std::shared_ptr<engine> engine_;
};

} // namespace godwit::io::http
