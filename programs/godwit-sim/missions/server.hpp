// Listens, has connections, and brings their requests to the service; holds long polls until there is news.
//
// Errors: listen gives a sentence. Thread: that of the context, for all but the constructor.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <tl/expected.hpp>

#include "programs/godwit-sim/missions/connection.hpp"
#include "programs/godwit-sim/missions/faulty_service.hpp"

namespace godwit::sim::missions {

struct server_tls {
  std::unique_ptr<boost::asio::ssl::context> usual;      // none: plain HTTP
  std::unique_ptr<boost::asio::ssl::context> wrong_host; // none: there is no such fault
};

class server {
public:
  static constexpr std::size_t max_connections = 256;
  static constexpr std::chrono::milliseconds accept_pause{100}; // when the system has no descriptor left

  using teller = std::function<void(std::string_view line)>;

  server(boost::asio::io_context& io, faulty_service& answering, fault_book& faults, server_tls tls, teller tell);

  // Again at the port of the last time, when PORT is 0 and there was one.
  [[nodiscard]] tl::expected<void, std::string> listen(const std::string& host, std::uint16_t port);
  [[nodiscard]] const boost::asio::ip::tcp::endpoint& where() const { return where_; }
  // Nobody is let in any more, and those that are in go.
  void stop_listening();
  [[nodiscard]] tl::expected<void, std::string> listen_again();
  [[nodiscard]] bool is_listening() const { return acceptor_.is_open(); }
  void end_connections();

  // Something has changed that a long poll may wait for.
  void wake_polls();

  [[nodiscard]] connection_figures figures() const;

private:
  struct held_poll {
    std::shared_ptr<connection> who;
    taken_call call;
    boost::asio::steady_timer timer;
  };

  [[nodiscard]] tl::expected<void, std::string> open();
  void accept();
  void accept_later();
  void welcome(boost::asio::ip::tcp::socket accepted);
  void asked(connection& who, request what);
  void answer(connection& who, const taken_call& call, patience how_long);
  void hold(connection& who, const taken_call& call, std::uint64_t wait_s);
  void end_of(connection& who);
  void tell(const taken_call& call, const delivery& what) const;

  boost::asio::io_context& io_;
  faulty_service& answering_;
  fault_book& faults_;
  server_tls tls_;
  teller teller_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::ip::tcp::endpoint where_;
  boost::asio::steady_timer pause_;
  std::map<connection*, std::shared_ptr<connection>> connections_;
  std::map<connection*, held_poll> polls_; // at most one of each connection
  connection_figures figures_;
};

} // namespace godwit::sim::missions
