// A connection as the stream on which Boost.Beast speaks: with TLS or without, and one kind of it instead of two.
//
// Only for websocket.cpp. What Beast asks for ends in the callbacks of the connection. Thread: that of the context.
// Source: Boost.Asio, AsyncReadStream and AsyncWriteStream; Boost.Beast, "Teardown".
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include "io/http/connection.hpp"

namespace godwit::io::http {

class websocket_wire {
public:
  using executor_type = boost::asio::io_context::executor_type;
  using error_code = boost::system::error_code;

  websocket_wire(boost::asio::io_context& io, std::unique_ptr<connection> over)
      : where_(io.get_executor()), over_(std::move(over)) {}

  [[nodiscard]] executor_type get_executor() const noexcept { return where_; }
  [[nodiscard]] connection& over() { return *over_; }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& to, Handler&& then) {
    boost::asio::mutable_buffer first;
    for (auto each = boost::asio::buffer_sequence_begin(to); each != boost::asio::buffer_sequence_end(to); ++each) {
      first = *each;
      if (first.size() != 0)
        break;
    }
    over_->read_some(first, kept(std::forward<Handler>(then)));
  }

  // The first two pieces: the head of a frame, and the text that all subscribers share.
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& from, Handler&& then) {
    std::array<std::string_view, 2> pieces;
    std::size_t count = 0;
    for (auto each = boost::asio::buffer_sequence_begin(from);
         count != pieces.size() && each != boost::asio::buffer_sequence_end(from); ++each) {
      const boost::asio::const_buffer piece(*each);
      if (piece.size() != 0)
        pieces[count++] = {static_cast<const char*>(piece.data()), piece.size()};
    }
    over_->write(pieces[0], pieces[1], kept(std::forward<Handler>(then)));
  }

  friend void beast_close_socket(websocket_wire& wire) { wire.over_->close(); }

  friend void teardown(boost::beast::role_type, websocket_wire& wire, error_code& failed) {
    failed = {};
    wire.over_->close();
  }

  template <class Handler>
  friend void async_teardown(boost::beast::role_type, websocket_wire& wire, Handler&& then) {
    auto whole = kept(std::forward<Handler>(then));
    wire.over_->shut_down([whole](const error_code& failed, std::size_t) { whole.call(failed); });
  }

private:
  // Beast's handlers can be moved only, and std::function copies.
  template <class Handler>
  struct kept_handler {
    std::shared_ptr<Handler> handler;
    void operator()(const error_code& failed, std::size_t bytes) const { std::move (*handler)(failed, bytes); }
    void call(const error_code& failed) const { std::move (*handler)(failed); }
  };
  template <class Handler>
  static kept_handler<std::decay_t<Handler>> kept(Handler&& handler) {
    return {std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler))};
  }

  executor_type where_;
  std::unique_ptr<connection> over_;
};

} // namespace godwit::io::http
