// tcp://HOST:PORT for stream_link: looks up the host, connects to the first of its addresses that answers.
//
// Source: tcp(7).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <sys/types.h>

#include "io/link/liveness.hpp"
#include "io/link/name_lookup.hpp"
#include "io/link/stream_link.hpp"
#include "io/link/uri.hpp"

namespace godwit::io::link {

// How a TCP connection of a link is set: small frames go out at once (TCP_NODELAY), it does not block, and a peer that
// has vanished without a word ends the connection after `vanished_after` instead of the quarter of an hour that TCP
// allows. Thread: pure. Source: tcp(7).

// Five heartbeats, after which a vehicle counts as lost anyway.
inline constexpr std::chrono::seconds tcp_peer_vanished_after{5};

[[nodiscard]] boost::system::error_code set_up_tcp(boost::asio::ip::tcp::socket& socket);

// As write(2), but never blocks and never raises SIGPIPE.
[[nodiscard]] ssize_t write_tcp(int stream, std::span<const std::byte> bytes);

class tcp_opener final : public stream_opener {
public:
  tcp_opener(boost::asio::io_context& io, const uri& where, std::chrono::milliseconds connect_timeout);
  ~tcp_opener() override;

  void open(std::function<void(result)> done) override;
  [[nodiscard]] ssize_t write(int stream, std::span<const std::byte> bytes) const override {
    return write_tcp(stream, bytes);
  }
  void discard_output(int) const override {} // closing a TCP socket does not wait
  [[nodiscard]] std::string where() const override { return place_; }
  [[nodiscard]] std::string why_it_ended(int error) const override;

private:
  using tcp = boost::asio::ip::tcp;

  void connect(const std::vector<boost::asio::ip::address>& addresses);
  void connected(const boost::system::error_code& failure);
  [[nodiscard]] bool is_connected_to_itself() const;

  uri where_;
  std::string place_; // HOST:PORT
  std::chrono::milliseconds connect_timeout_;
  name_lookup lookup_;
  std::shared_ptr<tcp::socket> socket_;
  boost::asio::steady_timer timer_;
  std::function<void(result)> done_;
  std::uint64_t tries_ = 0;
  bool timed_out_ = false;
  liveness alive_;
};

} // namespace godwit::io::link
