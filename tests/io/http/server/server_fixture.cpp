#include "tests/io/http/server/server_fixture.hpp"

#include <utility>

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <poll.h>

namespace godwit::io::http::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;

void say_target(server_request asked, responder answer) {
  answer.send({.content_type = "text/plain", .body = std::move(asked.target)});
}

running_server::running_server(handler handle, const server_settings& set, server_hooks others) {
  others.handle = std::move(handle);
  server_ = std::make_unique<server>(thread_.context(), set, std::move(others));
  const auto listening = server_->listen();
  EXPECT_TRUE(listening) << listening.error().message();
  port_ = server_->port();
  thread_.start();
}

running_server::~running_server() {
  destroy_server();
  thread_.stop();
}

void running_server::destroy_server() {
  thread_.run_inside([this] { server_.reset(); });
}

void running_server::inside(const std::function<void(server&)>& what) {
  thread_.run_inside([&] { what(*server_); });
}

server_counters running_server::counters() {
  server_counters now;
  inside([&](server& it) { now = it.counters(); });
  return now;
}

bool running_server::reaches(std::uint64_t server_counters::*what, std::uint64_t value) {
  const auto until = std::chrono::steady_clock::now() + long_time;
  while (counters().*what != value)
    if (std::chrono::steady_clock::now() > until)
      return false;
  return true;
}

raw_client::raw_client(std::uint16_t port) { socket_.connect({asio::ip::address_v4::loopback(), port}); }

void raw_client::write(const std::string& text) {
  error_code ignored; // the server may have closed: the test looks at what it said
  asio::write(socket_, asio::buffer(text), ignored);
}

raw_client::answer raw_client::read(bool is_head) {
  beast::http::response_parser<beast::http::string_body> parser;
  parser.skip(is_head);
  error_code failed;
  beast::http::read(socket_, buffer_, parser, failed);
  if (!failed)
    return parser.release();
  answer none;
  none.result(0U);
  return none;
}

std::string raw_client::read_to_end() {
  std::string all = beast::buffers_to_string(buffer_.data());
  buffer_.clear();
  error_code end;
  asio::read(socket_, asio::dynamic_buffer(all), end);
  was_reset_ = end != asio::error::eof;
  return all;
}

bool raw_client::hears_within(std::chrono::milliseconds time) {
  pollfd watched{socket_.native_handle(), POLLIN, 0};
  return ::poll(&watched, 1, static_cast<int>(time.count())) > 0;
}

bool raw_client::dribble_until_closed() {
  const auto until = std::chrono::steady_clock::now() + long_time;
  while (!hears_within(std::chrono::milliseconds(5))) {
    if (std::chrono::steady_clock::now() > until)
      return false;
    write("x");
  }
  return read_to_end().empty();
}

void raw_client::close_sending() {
  error_code ignored; // as in write
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
}

void raw_client::close() { socket_.close(); }

} // namespace godwit::io::http::test
