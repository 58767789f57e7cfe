#include "io/http/exchange.hpp"

#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <sys/socket.h>

namespace godwit::io::http {
namespace connection_pool_test {

using namespace std::chrono_literals;
using tcp = boost::asio::ip::tcp;

class http_connection_pool : public testing::Test {
protected:
  static constexpr std::size_t max_kept = 2;

  // One that is connected; its other end is in others_.
  std::unique_ptr<connection> connected() {
    auto made = std::make_unique<connection>(io_);
    made->socket().connect(listener_.local_endpoint());
    others_.push_back(listener_.accept());
    return made;
  }

  boost::asio::io_context io_;
  tcp::acceptor listener_{io_, {boost::asio::ip::address_v4::loopback(), 0}};
  std::deque<tcp::socket> others_;
  std::atomic<std::uint64_t> gauge_{0};
  connection_pool kept_{max_kept, 10s, gauge_};
  std::chrono::steady_clock::time_point now_{};
};

TEST_F(http_connection_pool, give_the_one_that_was_used_last) {
  auto first = connected();
  auto second = connected();
  const connection* const last = second.get();
  kept_.put(std::move(first), now_);
  kept_.put(std::move(second), now_ + 1s);
  EXPECT_EQ(gauge_, 2U);
  EXPECT_EQ(kept_.take(now_ + 2s).get(), last);
  EXPECT_EQ(gauge_, 1U);
}

TEST_F(http_connection_pool, are_never_more_than_the_bound) {
  for (int i = 0; i < 5; ++i)
    kept_.put(connected(), now_);
  EXPECT_EQ(gauge_, max_kept);
}

TEST_F(http_connection_pool, are_not_given_when_they_are_too_old) {
  kept_.put(connected(), now_);
  EXPECT_EQ(kept_.take(now_ + 10s), nullptr);
  EXPECT_EQ(gauge_, 0U);
}

TEST_F(http_connection_pool, are_not_given_when_the_other_side_has_closed_or_spoken) {
  auto closed = connected();
  auto spoken = connected();
  others_[0].close();
  boost::asio::write(others_[1], boost::asio::buffer("?", 1));
  char byte = 0;
  for (auto* each : {closed.get(), spoken.get()}) // until it has arrived
    ::recv(each->socket().native_handle(), &byte, 1, MSG_PEEK);
  kept_.put(std::move(closed), now_);
  kept_.put(std::move(spoken), now_);
  EXPECT_EQ(kept_.take(now_), nullptr);
}

} // namespace connection_pool_test
} // namespace godwit::io::http
