// How a handler answers one request: at once or later, as a whole or piece by piece.
//
//   answer.send({.body = text});                                     the whole
//   answer.start({.body = first}, size, [&] { answer.write(...); }); piece by piece; each NEXT: the piece has gone out
//   answer.finish();
//
// Exactly one answer belongs to a request. A responder that is destroyed without one resets the connection, so that the
// client does not wait for nothing. When the client goes first, nothing happens any more.
//
// Thread: send and abort from any, as long as the context of the server is there; the others only in its thread, where
// all callbacks come.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/io_context.hpp>

#include "io/http/connection.hpp"
#include "io/http/server/response_head.hpp"

namespace godwit::io::http {

class session;

class responder {
public:
  using next = std::function<void()>;
  // EARLY: what the client has sent after its request.
  using taker = std::function<void(std::unique_ptr<connection> taken, std::string early)>;

  responder(std::weak_ptr<session> to, std::uint64_t request_number, boost::asio::io_context::executor_type where)
      : to_(std::move(to)), request_number_(request_number), where_(where) {}
  ~responder();
  responder(responder&&) = default;
  responder& operator=(responder&&) = delete;
  responder(const responder&) = delete;
  responder& operator=(const responder&) = delete;

  void send(server_response whole);
  // The beginning: WHAT's body is the first part of one of BODY_BYTES; none: it ends with the connection.
  void start(const server_response& what, std::optional<std::uint64_t> body_bytes, next then);
  // One at a time: not before the NEXT of the one before. More than was promised resets the connection.
  void write(std::string bytes, next then);
  // Less than was promised resets the connection.
  void finish();
  // Resets the connection: the client sees that its answer, or the rest of it, is missing.
  void abort();

  // To be called when the client goes before it has its answer. Set within the handler.
  void on_gone(next then);
  // Hands the connection over, for another protocol: from then on neither bounds nor time-outs of the server hold for
  // it. Within the handler, or later after keep_unread(). The answer, 101 or another, is the taker's.
  void upgrade(const taker& then);
  // Nothing is read until there is an answer, and nobody sees that the client has gone. Within the handler only.
  void keep_unread();

private:
  std::weak_ptr<session> to_;
  std::uint64_t request_number_;
  boost::asio::io_context::executor_type where_;
};

} // namespace godwit::io::http
