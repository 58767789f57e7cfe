// A server in a thread of its own, and clients that know no more of HTTP than their test, so that they can do it wrong.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <gtest/gtest.h>

#include "io/http/server/server.hpp"
#include "io/link/io_thread.hpp"

namespace godwit::io::http::test {

// Far longer than any of it takes: a test that waits so long has failed.
inline constexpr std::chrono::seconds long_time{60};
inline constexpr std::chrono::milliseconds short_time{50}; // for the time-out that a test is about

using handler = std::function<void(server_request asked, responder answer)>;

// Answers with the target, as text.
void say_target(server_request asked, responder answer);

class running_server {
public:
  explicit running_server(handler handle = say_target, const server_settings& set = {}, server_hooks others = {});
  ~running_server();
  running_server(const running_server&) = delete;
  running_server& operator=(const running_server&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  // What WHAT does, in the thread of the server.
  void inside(const std::function<void(server&)>& what);
  [[nodiscard]] server_counters counters();
  // Until WHAT, one of the counters, has this value; false: it never has.
  [[nodiscard]] bool reaches(std::uint64_t server_counters::*what, std::uint64_t value);
  void destroy_server();                     // the thread goes on
  void destroy_inside() { server_.reset(); } // in the thread of the server

private:
  link::io_thread thread_;
  std::unique_ptr<server> server_;
  std::uint16_t port_ = 0;
};

class raw_client {
public:
  using answer = boost::beast::http::response<boost::beast::http::string_body>;

  explicit raw_client(const running_server& to) : raw_client(to.port()) {}
  explicit raw_client(std::uint16_t port);

  void write(const std::string& text);
  // The next answer; status 0: there is none.
  [[nodiscard]] answer read(bool is_head = false);
  // All that comes until the server closes, and how it did.
  [[nodiscard]] std::string read_to_end();
  [[nodiscard]] bool was_reset() const { return was_reset_; }
  // Whether the server says something, or closes, in this time.
  [[nodiscard]] bool hears_within(std::chrono::milliseconds time);
  // A byte every few milliseconds, until the server closes; false: it never does.
  [[nodiscard]] bool dribble_until_closed();
  void close_sending();
  void close();

private:
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_{io_};
  boost::beast::flat_buffer buffer_;
  bool was_reset_ = false;
};

[[nodiscard]] inline std::string get(const std::string& target, const std::string& headers = {}) {
  return "GET " + target + " HTTP/1.1\r\nHost: x\r\n" + headers + "\r\n";
}

} // namespace godwit::io::http::test
