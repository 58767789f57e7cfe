// Makes one connection that is ready for a request.
//
//   look up --> connect to each address in turn --> [CONNECT, for https through a proxy] --> [TLS] --> done
//                        any of them fails --> done with an error
//
// Every address has its part of the time, so that one that swallows everything does not use up all of it. The time as a
// whole is watched by the owner, who stops the connector.
//
// Errors: as values, without the place. Thread: the client's. Source: RFC 9110, 9.3.6 (CONNECT).
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "io/http/connection.hpp"
#include "io/http/error.hpp"
#include "io/http/response_reader.hpp"
#include "io/http/settings.hpp"
#include "io/link/name_lookup.hpp"

namespace godwit::io::http {

class connector : public std::enable_shared_from_this<connector> {
public:
  static constexpr std::size_t max_addresses = 4;
  using done = std::function<void(result<std::unique_ptr<connection>>)>;

  connector(boost::asio::io_context& io, const destination& to, boost::asio::ssl::context* tls,
            std::chrono::milliseconds limit);

  void start(done then); // once
  void stop();           // THEN is not called any more
  // For the sentence about a time-out: "looking up the host", "connecting to 192.0.2.1:443" ...
  [[nodiscard]] const std::string& step() const { return step_; }

private:
  void looked_up(const link::found_addresses& found);
  void try_next();
  void connected(const boost::system::error_code& failed, const std::string& place);
  void ask_proxy();
  void read_proxy();
  void proxy_answered();
  void begin_tls();
  void finish(result<std::unique_ptr<connection>> end);
  void fail(error why);

  boost::asio::io_context& io_;
  const destination& to_;
  boost::asio::ssl::context* tls_;
  std::chrono::milliseconds limit_;
  link::name_lookup lookup_;
  boost::asio::steady_timer address_timer_;
  int attempt_ = 0; // counts the addresses, so that the timer of one does not close the connection of the next
  std::vector<boost::asio::ip::address> addresses_; // those that were not tried yet, the next one last
  std::chrono::milliseconds address_limit_{0};
  std::unique_ptr<connection> connection_;
  std::string proxy_request_;
  std::optional<response_reader> proxy_answer_;
  std::array<std::byte, 1024> piece_{};
  std::string step_;
  done then_;
};

} // namespace godwit::io::http
