// The service on its HTTP server: brings requests to it, holds long polls until there is news, and has answers
// delivered with their faults.
//
// Errors: listen gives a sentence. Thread: that of the context, for all but the constructor.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <tl/expected.hpp>

#include "io/http/server/server.hpp"
#include "programs/godwit-sim/missions/faulty_service.hpp"

namespace godwit::sim::missions {

struct server_tls {
  std::shared_ptr<boost::asio::ssl::context> usual;      // none: plain HTTP
  std::shared_ptr<boost::asio::ssl::context> wrong_host; // none: there is no such fault
};

class service_server {
public:
  using teller = std::function<void(std::string_view line)>;

  service_server(boost::asio::io_context& io, io::http::server_settings set, faulty_service& answering,
                 fault_book& faults, server_tls tls, teller tell);

  // Again at the port of the last time.
  [[nodiscard]] tl::expected<void, std::string> listen();
  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  [[nodiscard]] std::string url() const { return (tls_.usual ? "https://" : "http://") + server_.place(); }
  void stop_listening() { server_.stop_listening(); }
  void end_connections() { server_.end_connections(); }

  // Something has changed that a long poll may wait for.
  void wake_polls();

  [[nodiscard]] connection_figures figures() const;

private:
  struct held_poll {
    io::http::responder to;
    taken_call call;
    boost::asio::steady_timer timer;
  };

  void answer(const taken_call& call, io::http::responder to);
  void give(const taken_call& call, io::http::responder to, delivery what);
  void hold(const taken_call& call, io::http::responder to, std::uint64_t wait_s);
  void end_poll(std::uint64_t number, patience how_long);

  boost::asio::io_context& io_;
  faulty_service& answering_;
  server_tls tls_;
  teller teller_;
  std::uint64_t last_poll_ = 0;
  std::map<std::uint64_t, held_poll> polls_; // at most one of each connection
  io::http::server server_;                  // last: it calls the others
};

} // namespace godwit::sim::missions
