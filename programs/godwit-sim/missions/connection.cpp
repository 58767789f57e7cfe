#include "programs/godwit-sim/missions/connection.hpp"

#include <algorithm>
#include <utility>

namespace godwit::sim::missions {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

// A slow answer comes in so many pieces a second.
constexpr std::uint64_t pieces_a_second = 10;

} // namespace

connection::connection(asio::ip::tcp::socket accepted, callbacks around)
    : wire_(std::move(accepted)), around_(std::move(around)), watchdog_(wire_.executor()), pace_(wire_.executor()) {}

void connection::start(asio::ssl::context* tls) {
  if (tls == nullptr)
    return read();
  watch(handshake_timeout);
  wire_.shake_hands(*tls, [self = shared_from_this()](const error_code& failed, std::size_t) {
    if (failed)
      self->end();
    else
      self->read();
  });
}

// Whoever waits for something asks for it before or after: nothing runs in between. A later call takes the place of an
// earlier one.
void connection::watch(std::chrono::steady_clock::duration time) {
  watchdog_.expires_after(time);
  watchdog_.async_wait([self = shared_from_this(), number = ++watch_](const error_code& cancelled) {
    if (!cancelled && number == self->watch_)
      self->end();
  });
}

void connection::stop_watching() {
  ++watch_;
  watchdog_.cancel();
}

void connection::read() {
  if (has_ended_)
    return;
  watch(reader_.has_begun() ? silence_timeout : idle_timeout);
  wire_.read_some(asio::buffer(bytes_), [self = shared_from_this()](const error_code& failed, std::size_t bytes) {
    self->have_read(failed, bytes);
  });
}

void connection::have_read(const error_code& failed, std::size_t bytes) {
  if (failed)
    return end();
  go_on(reader_.feed(std::span(bytes_).first(bytes)));
}

void connection::go_on(progress how_far) {
  if (has_ended_)
    return;
  switch (how_far) {
  case progress::more:
    return reader_.take_continue() ? send_continue() : read();
  case progress::complete:
    stop_watching(); // how long an answer may take is the business of whoever gives it
    is_last_ = !reader_.can_be_kept();
    return around_.asked(*this, reader_.take());
  case progress::refused:
    is_last_ = true;
    return deliver({.what = reader_.refusal(), .cut_after = {}});
  }
}

void connection::send_continue() {
  watch(silence_timeout);
  wire_.write("HTTP/1.1 100 Continue\r\n\r\n", [self = shared_from_this()](const error_code& failed, std::size_t) {
    if (failed)
      self->end();
    else
      self->read();
  });
}

void connection::hold() {
  wire_.wait_readable([self = shared_from_this()](const error_code& failed, std::size_t) {
    const bool is_waiting = !self->delivery_ && !self->has_ended_;
    if (!failed && is_waiting && self->wire_.is_gone())
      self->end();
  });
}

void connection::deliver(const delivery& what) {
  if (has_ended_)
    return;
  delivery_ = what;
  if (what.delay.count() == 0)
    return begin_sending();
  pace_.expires_after(what.delay);
  pace_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (!cancelled)
      self->begin_sending();
  });
}

void connection::begin_sending() {
  if (has_ended_)
    return;
  if (delivery_->is_lost) {
    wire_.reset();
    return end();
  }
  sending_.emplace(*delivery_, is_last_);
  send();
}

void connection::send() {
  if (has_ended_)
    return;
  const auto slow = delivery_->bytes_per_s;
  const auto max = slow == 0 ? piece_bytes : std::max<std::size_t>(1, slow / pieces_a_second);
  watch(silence_timeout);
  wire_.write(sending_->take(max), [self = shared_from_this()](const error_code& failed, std::size_t) {
    if (failed)
      self->end();
    else
      self->have_sent();
  });
}

void connection::have_sent() {
  if (has_ended_)
    return;
  if (!sending_->is_at_end())
    return delivery_->bytes_per_s == 0 ? send() : send_more_later();
  if (delivery_->cut_after) {
    wire_.reset();
    return end();
  }
  delivery_.reset();
  sending_.reset();
  if (is_last_)
    return say_goodbye();
  go_on(reader_.next());
}

void connection::send_more_later() {
  stop_watching();
  // Fewer bytes a second than pieces: a byte at a time, and longer pauses.
  const auto pieces = std::min(pieces_a_second, delivery_->bytes_per_s);
  pace_.expires_after(std::chrono::nanoseconds(std::chrono::seconds(1)) / pieces);
  pace_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (!cancelled)
      self->send();
  });
}

// Closing at once would throw away the answer when the client is still sending: so whatever comes is read and dropped
// until it closes, or for a moment.
void connection::say_goodbye() {
  watch(goodbye_timeout);
  wire_.say_goodbye([self = shared_from_this()](const error_code&, std::size_t) { self->drain(); });
}

void connection::drain() {
  if (has_ended_)
    return;
  wire_.read_raw(asio::buffer(bytes_), [self = shared_from_this()](const error_code& failed, std::size_t) {
    if (failed)
      self->end();
    else
      self->drain();
  });
}

void connection::end() {
  if (std::exchange(has_ended_, true))
    return;
  stop_watching();
  pace_.cancel();
  wire_.close();
  around_.ended(*this);
}

} // namespace godwit::sim::missions
