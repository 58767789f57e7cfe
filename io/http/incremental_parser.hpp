// Beast's parser, fed with the bytes of a connection as they come, in pieces of any size.
//
//   head --> body --> done --begin()--> head ...         what lies after a message is kept for the next one
//
// Errors: those of Beast; need_more is none of them, but the request for more bytes. Thread: as any value.
// Source: RFC 9112; Boost.Beast 1.81.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/buffers_range.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/optional/optional.hpp>

namespace godwit::io::http {

// Lets Beast's parser hand the bytes of a body on as they come, without a second buffer.
//
// The names in here are those that Beast asks for. Thread: that of the parser.
// Source: Boost.Beast, named requirements Body and BodyReader.
struct sink_body {
  // Sets the error to end the parsing.
  using value_type = std::function<void(std::span<const std::byte> bytes, boost::beast::error_code& error)>;

  class reader {
  public:
    template <bool IsRequest, class Fields>
    reader(boost::beast::http::header<IsRequest, Fields>&, value_type& take) : take_(take) {}

    void init(const boost::optional<std::uint64_t>&, boost::beast::error_code& error) { error = {}; }

    template <class Buffers>
    std::size_t put(const Buffers& buffers, boost::beast::error_code& error) {
      error = {};
      std::size_t taken = 0;
      for (const boost::asio::const_buffer each : boost::beast::buffers_range_ref(buffers)) {
        take_({static_cast<const std::byte*>(each.data()), each.size()}, error);
        if (error)
          return taken;
        taken += each.size();
      }
      return taken;
    }

    void finish(boost::beast::error_code& error) { error = {}; }

  private:
    value_type& take_;
  };
};

template <bool IsRequest>
class incremental_parser {
public:
  using parser = boost::beast::http::parser<IsRequest, sink_body>;

  // BUFFER_BYTES: what may wait unread; more is a broken invariant of whoever feeds.
  explicit incremental_parser(std::size_t buffer_bytes) : buffer_(buffer_bytes) {}

  // The next message. The limit of the body is the sink's.
  parser& begin(std::size_t head_limit, sink_body::value_type take_body) {
    needs_more_ = false;
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(head_limit));
    parser_->body_limit(boost::none);
    parser_->get().body() = std::move(take_body);
    return *parser_;
  }
  [[nodiscard]] parser& current() { return *parser_; }
  [[nodiscard]] const parser& current() const { return *parser_; }

  void feed(std::span<const std::byte> bytes) {
    const auto from = boost::asio::buffer(bytes.data(), bytes.size());
    buffer_.commit(boost::asio::buffer_copy(buffer_.prepare(bytes.size()), from));
  }
  [[nodiscard]] std::size_t unread_bytes() const { return buffer_.size(); }
  [[nodiscard]] std::string_view unread() const {
    return {static_cast<const char*>(buffer_.data().data()), buffer_.size()};
  }

  // Reads on, up to the end of the head at most when it is in the head.
  boost::beast::error_code step() {
    if (needs_more_ && parser_->is_header_done() && buffer_.size() < shortest_last_chunk)
      return boost::beast::http::error::need_more;
    boost::beast::error_code code;
    buffer_.consume(parser_->put(buffer_.data(), code));
    needs_more_ = code == boost::beast::http::error::need_more;
    return code;
  }

private:
  // "0", two line ends. After the head of a chunk that is incomplete there always come as many bytes as this; and with
  // fewer the parser of Boost 1.81 ends the process by an assertion, when the last chunk comes byte by byte.
  static constexpr std::size_t shortest_last_chunk = 5;

  boost::beast::flat_buffer buffer_;
  std::optional<parser> parser_;
  bool needs_more_ = false; // what is in the buffer was looked at and is incomplete
};

} // namespace godwit::io::http
