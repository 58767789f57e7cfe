#include "programs/godwit-sim/missions/faulty_delivery.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include <boost/asio/steady_timer.hpp>

namespace godwit::sim::missions {
namespace {

namespace asio = boost::asio;

constexpr std::size_t space_bytes = 64 * 1024; // of padding, at a time
constexpr std::uint64_t pieces_a_second = 10;  // of a slow answer

// Kept by whatever it waits for.
class faulty_delivery : public std::enable_shared_from_this<faulty_delivery> {
public:
  faulty_delivery(asio::io_context& io, io::http::responder to, delivery what)
      : timer_(io), to_(std::move(to)), what_(std::move(what)) {}

  void start() {
    if (what_.delay.count() == 0)
      return begin();
    wait(what_.delay, &faulty_delivery::begin);
  }

private:
  void wait(std::chrono::nanoseconds time, void (faulty_delivery::*then)()) {
    timer_.expires_after(time);
    timer_.async_wait([self = shared_from_this(), then](const boost::system::error_code& cancelled) {
      if (!cancelled)
        ((*self).*then)();
    });
  }

  void begin() {
    if (what_.is_lost)
      return to_.abort();
    if (what_.bytes_per_s == 0 && !what_.cut_after && what_.padding == 0)
      return to_.send(std::move(what_.what));
    rest_ = std::exchange(what_.what.body, {});
    const auto size = rest_.size() + what_.padding;
    if (what_.cut_after) {
      rest_.resize(*what_.cut_after);
      what_.padding = 0;
    }
    to_.start(what_.what, size, [self = shared_from_this()] { self->go_on(); });
  }

  void go_on() {
    if (rest_.empty() && what_.padding != 0) {
      rest_.assign(std::min<std::uint64_t>(space_bytes, what_.padding), ' ');
      what_.padding -= rest_.size();
    }
    if (rest_.empty())
      return what_.cut_after ? to_.abort() : to_.finish();
    const auto slow = what_.bytes_per_s;
    const auto size = slow == 0 ? rest_.size() : std::max<std::size_t>(1, slow / pieces_a_second);
    auto piece = rest_.substr(0, size);
    rest_.erase(0, size);
    to_.write(std::move(piece), [self = shared_from_this()] { self->have_written(); });
  }

  void have_written() {
    if (what_.bytes_per_s == 0)
      return go_on();
    // Fewer bytes a second than pieces: a byte at a time, and longer pauses.
    const auto pieces = std::min(pieces_a_second, what_.bytes_per_s);
    wait(std::chrono::nanoseconds(std::chrono::seconds(1)) / pieces, &faulty_delivery::go_on);
  }

  asio::steady_timer timer_;
  io::http::responder to_;
  delivery what_;
  std::string rest_; // of the body, and then of the padding
};

} // namespace

void deliver(asio::io_context& io, io::http::responder to, delivery what) {
  std::make_shared<faulty_delivery>(io, std::move(to), std::move(what))->start();
}

} // namespace godwit::sim::missions
