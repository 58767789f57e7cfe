// Each fault of the way, as it arrives at a client that knows nothing of HTTP.
#include "programs/godwit-sim/missions/faulty_delivery.hpp"

#include <string>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>

#include "io/http/server/server.hpp"
#include "io/link/io_thread.hpp"

namespace godwit::sim::missions {
namespace faulty_delivery_test {

namespace asio = boost::asio;
using asio::ip::tcp;

struct arrived {
  std::string head;
  std::string body;
  boost::system::error_code end; // eof, or the connection was reset
};

// What a client gets for one request, which is answered with WHAT.
arrived arrival_of(const delivery& what) {
  io::link::io_thread thread;
  io::http::server server(thread.context(), {}, {.handle = [&](io::http::server_request, io::http::responder to) {
                            deliver(thread.context(), std::move(to), what);
                          }});
  EXPECT_TRUE(server.listen());
  thread.start();
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), server.port()});
  asio::write(socket, asio::buffer(std::string("GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")));
  arrived got;
  std::string all;
  asio::read(socket, asio::dynamic_buffer(all), got.end);
  thread.stop();
  const auto end_of_head = all.find("\r\n\r\n");
  if (end_of_head != std::string::npos) {
    got.head = all.substr(0, end_of_head + 2);
    got.body = all.substr(end_of_head + 4);
  }
  return got;
}

delivery of_body(const std::string& body) { return {.what = {.body = body, .headers = {}}, .cut_after = {}}; }

TEST(missions_faulty_delivery, without_a_fault_the_answer_arrives_as_it_is) {
  const auto got = arrival_of(of_body("hello"));
  EXPECT_EQ(got.body, "hello");
  EXPECT_NE(got.head.find("\r\nContent-Length: 5\r\n"), std::string::npos);
  EXPECT_EQ(got.end, asio::error::eof);
}

TEST(missions_faulty_delivery, a_lost_answer_is_a_reset_without_a_byte) {
  auto lost = of_body("hello");
  lost.is_lost = true;
  const auto got = arrival_of(lost);
  EXPECT_EQ(got.head + got.body, "");
  EXPECT_EQ(got.end, asio::error::connection_reset);
}

TEST(missions_faulty_delivery, a_body_that_is_cut_still_promises_all_of_it) {
  auto cut = of_body("0123456789");
  cut.cut_after = 4;
  const auto got = arrival_of(cut);
  EXPECT_NE(got.head.find("\r\nContent-Length: 10\r\n"), std::string::npos);
  EXPECT_EQ(std::string("0123").substr(0, got.body.size()), got.body); // a reset may overtake them
  EXPECT_EQ(got.end, asio::error::connection_reset);
}

TEST(missions_faulty_delivery, padding_is_spaces_behind_the_body) {
  auto padded = of_body("{}");
  padded.padding = 200'000;
  const auto got = arrival_of(padded);
  EXPECT_EQ(got.body, "{}" + std::string(200'000, ' '));
  EXPECT_EQ(got.end, asio::error::eof);
}

TEST(missions_faulty_delivery, a_slow_answer_comes_late_and_whole) {
  auto slow = of_body("abc");
  slow.bytes_per_s = 30; // a piece of three bytes, and a pause of 100 ms behind it
  slow.delay = std::chrono::milliseconds(20);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(arrival_of(slow).body, "abc");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(120));
}

} // namespace faulty_delivery_test
} // namespace godwit::sim::missions
