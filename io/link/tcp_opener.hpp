// tcp://HOST:PORT for stream_link: looks up the host, connects to the first of its addresses that answers.
//
// Small frames go out at once (TCP_NODELAY), and a peer that has vanished without a word ends the connection after
// `vanished_after` instead of the quarter of an hour that TCP allows. Source: tcp(7).
#pragma once

#include <chrono>
#include <cstdint>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "io/link/name_lookup.hpp"
#include "io/link/stream_opener.hpp"
#include "io/link/uri.hpp"

namespace godwit::io::link {

class tcp_opener final : public stream_opener {
public:
  // Five heartbeats, after which a vehicle counts as lost anyway.
  static constexpr std::chrono::seconds vanished_after{5};

  tcp_opener(boost::asio::io_context& io, const uri& where, std::chrono::milliseconds connect_timeout);

  void open(std::function<void(result)> done) override;
  [[nodiscard]] ssize_t write(int stream, std::span<const std::byte> bytes) const override;
  void discard_output(int) const override {} // closing a TCP socket does not wait
  [[nodiscard]] std::string where() const override { return place_; }
  [[nodiscard]] std::string why_it_ended(int error) const override;

private:
  using tcp = boost::asio::ip::tcp;

  void connect(const std::vector<boost::asio::ip::address>& addresses);
  void connected(const boost::system::error_code& failure);
  [[nodiscard]] bool is_connected_to_itself() const;
  [[nodiscard]] boost::system::error_code set_up();

  uri where_;
  std::string place_; // HOST:PORT
  std::chrono::milliseconds connect_timeout_;
  name_lookup lookup_;
  tcp::socket socket_;
  boost::asio::steady_timer timer_;
  std::function<void(result)> done_;
  std::uint64_t tries_ = 0;
  bool timed_out_ = false;
};

} // namespace godwit::io::link
