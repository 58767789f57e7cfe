// Lets Beast's parser hand the bytes of a body on as they come, without a second buffer.
//
// The names in here are those that Beast asks for. Thread: that of the parser.
// Source: Boost.Beast, named requirements Body and BodyReader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/buffers_range.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/optional/optional.hpp>

namespace godwit::io::http {

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

} // namespace godwit::io::http
