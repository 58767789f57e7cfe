#include "io/http/exchange.hpp"

#include <algorithm>

#include <boost/asio/error.hpp>
#include <boost/asio/ssl/error.hpp>

#include "io/http/request_head.hpp"
#include "io/http/secret_file.hpp"
#include "io/http/tls.hpp"

namespace godwit::io::http {

namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using std::chrono::milliseconds;

std::string in_seconds(milliseconds time) {
  const auto tenths = time.count() / 100;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

} // namespace

exchange::exchange(shared_parts& parts, request asked, done then, std::function<void()> ended)
    : parts_(parts), asked_(std::move(asked)), then_(std::move(then)), ended_(std::move(ended)), total_timer_(parts.io),
      phase_timer_(parts.io) {}

void exchange::wait() {
  total_timer_.expires_after(total_timeout());
  total_timer_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (!cancelled)
      self->stop(errc::total_timeout,
                 "not done in " + in_seconds(self->total_timeout()) + " as a whole, while " + self->where_it_was());
  });
}

void exchange::start() {
  if (phase_ == phase::ended)
    return;
  if (parts_.to.has_token) {
    auto loaded = load_token(parts_.set.token_file);
    if (!loaded)
      return fail(loaded.error());
    token_ = std::move(*loaded);
  }
  head_ = request_head(asked_, parts_.to, token_.revealed());
  piece_.resize(read_piece_bytes);
  if (auto kept = parts_.pool.take(clock::now())) {
    parts_.counters.reused.add();
    is_reused_ = true;
    return use(std::move(kept));
  }
  connect();
}

void exchange::connect() {
  phase_ = phase::connecting;
  phase_timer_.expires_after(parts_.set.connect_timeout);
  phase_timer_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (!cancelled && self->phase_ == phase::connecting)
      self->connected(failure(errc::connect_timeout, "no connection in " +
                                                         in_seconds(self->parts_.set.connect_timeout) + ", while " +
                                                         self->where_it_was()));
  });
  connector_ = std::make_shared<connector>(parts_.io, parts_.to, parts_.tls.get(), parts_.set.connect_timeout);
  connector_->start(
      [self = shared_from_this()](result<std::unique_ptr<connection>> made) { self->connected(std::move(made)); });
}

void exchange::connected(result<std::unique_ptr<connection>> made) {
  if (phase_ != phase::connecting)
    return;
  phase_timer_.cancel();
  if (!made) {
    parts_.counters.connect_errors.add();
    return fail(std::move(made.error()));
  }
  parts_.counters.connections.add();
  connector_.reset();
  use(std::move(*made));
}

void exchange::use(std::unique_ptr<connection> ready) {
  phase_ = phase::sending;
  connection_ = std::move(ready);
  body_sent_ = 0;
  is_sent_ = false;
  reader_.emplace(reader_rules{asked_.max_body_bytes.value_or(parts_.set.max_body_bytes), asked_.expected_content_type,
                               false, asked_.on_body, asked_.accepts_compressed, asked_.on_head});
  last_byte_at_ = clock::now();
  watch_reading();
  send_piece();
}

void exchange::send_piece() {
  const auto head = body_sent_ == 0 ? head_.revealed() : std::string_view{};
  const auto piece = std::string_view(asked_.body).substr(body_sent_, send_piece_bytes);
  connection_->write(head, piece,
                     [self = shared_from_this(), size = piece.size()](const error_code& failed, std::size_t sent) {
                       if (self->phase_ != phase::sending)
                         return;
                       self->parts_.counters.request_bytes.add(sent);
                       self->last_byte_at_ = clock::now();
                       self->body_sent_ += failed ? 0 : size;
                       if (!failed && self->body_sent_ < self->asked_.body.size())
                         return self->send_piece();
                       self->is_sent_ = !failed;
                       self->phase_ = phase::receiving;
                       self->read_piece();
                     });
}

void exchange::read_piece() {
  connection_->read_some(asio::buffer(piece_),
                         [self = shared_from_this()](const error_code& failed, std::size_t bytes) {
                           if (self->phase_ == phase::receiving)
                             self->received(failed, bytes);
                         });
}

void exchange::received(const error_code& failed, std::size_t bytes) {
  parts_.counters.response_bytes.add(bytes);
  last_byte_at_ = clock::now();
  if (bytes != 0)
    if (auto taken = reader_->feed(std::span(piece_).first(bytes)); !taken)
      return fail(std::move(taken.error()));
  if (failed && !reader_->is_complete())
    return stream_ended(failed);
  go_on_reading();
}

void exchange::go_on_reading() {
  if (reader_->is_complete())
    return finish(reader_->take());
  is_paused_ = reader_->take_pause();
  if (!is_paused_)
    read_piece();
}

void exchange::stream_ended(const error_code& failed) {
  if (!reader_->has_begun() && repeat())
    return;
  if (is_tls_alert(failed))
    return fail(alert_error(failed));
  const bool is_closed = failed == asio::error::eof || failed == asio::ssl::error::stream_truncated;
  if (!is_closed)
    return fail({reader_->has_begun() ? errc::truncated : errc::connection_lost,
                 std::string("the connection broke off ") +
                     (reader_->has_begun() ? "in the middle of the answer: " : "before an answer came: ") +
                     failed.message(),
                 {}});
  if (auto ended = reader_->end_of_stream(failed == asio::error::eof); !ended)
    return fail(std::move(ended.error()));
  finish(reader_->take());
}

// The service may close a kept connection at any time, also just when a request is on its way: RFC 9112, 9.3.1.
bool exchange::repeat() {
  if (!is_reused_ || !may_repeat(asked_))
    return false;
  parts_.counters.repeated.add();
  is_reused_ = false;
  connection_.reset();
  phase_timer_.cancel();
  connect();
  return true;
}

void exchange::watch_reading() {
  phase_timer_.expires_at(last_byte_at_ + read_timeout());
  phase_timer_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (cancelled || (self->phase_ != phase::sending && self->phase_ != phase::receiving))
      return;
    const auto now = clock::now();
    if (self->is_paused_)
      self->last_byte_at_ = now;
    if (now < self->last_byte_at_ + self->read_timeout())
      return self->watch_reading();
    self->stop(errc::read_timeout,
               "no byte in " + in_seconds(self->read_timeout()) + ", while " + self->where_it_was());
  });
}

void exchange::resume() {
  if (!is_paused_ || phase_ != phase::receiving)
    return;
  is_paused_ = false;
  last_byte_at_ = clock::now();
  read_piece();
}

std::string exchange::place() const {
  const std::string_view target = asked_.target;
  return parts_.to.base.origin() + parts_.to.base.path + std::string(target.substr(0, target.find('?')));
}

std::string exchange::where_it_was() const {
  switch (phase_) {
  case phase::waiting:
    return "waiting for a free connection: others take long";
  case phase::connecting:
    return connector_->step();
  case phase::sending:
    return "sending the request";
  default:
    return is_paused_ ? "whoever takes the body had it wait" : "waiting for the answer";
  }
}

milliseconds exchange::read_timeout() const { return asked_.read_timeout.value_or(parts_.set.read_timeout); }
milliseconds exchange::total_timeout() const { return asked_.total_timeout.value_or(parts_.set.total_timeout); }

void exchange::stop(errc code, std::string why) { fail({code, std::move(why), {}}); }

void exchange::fail(error why) {
  if (why.where.empty())
    why.where = place();
  finish(tl::make_unexpected(std::move(why)));
}

// A service may echo what it was sent.
void exchange::redact_token(result<response>& end) const {
  if (!end) {
    redact(end.error().what, token_.revealed());
    return;
  }
  redact(end->body, token_.revealed());
  for (auto& each : end->headers)
    redact(each.value, token_.revealed());
}

void exchange::finish(result<response> end) {
  if (phase_ == phase::ended)
    return;
  redact_token(end);
  if (end && connection_ && reader_->can_be_kept() && is_sent_)
    parts_.pool.put(std::move(connection_), clock::now());
  phase_ = phase::ended;
  total_timer_.cancel();
  phase_timer_.cancel();
  if (connector_)
    connector_->stop();
  if (connection_)
    connection_->close(); // and kept until the handlers that it still calls are gone
  head_ = {};
  token_ = {};
  asked_.on_body = nullptr;
  reader_.reset();
  const auto self = shared_from_this();
  std::exchange(ended_, nullptr)();
  std::exchange(then_, nullptr)(std::move(end));
}

namespace {

void replace_all(std::string& text, std::string_view what) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + redacted.size()))
    text.replace(at, what.size(), redacted);
}

} // namespace

void redact(std::string& text, std::string_view token) {
  if (token.size() < min_redacted_bytes)
    return;
  replace_all(text, token);
  if (token.find('/') == std::string_view::npos)
    return;
  std::string escaped;
  for (const char each : token)
    escaped += each == '/' ? "\\/" : std::string(1, each);
  replace_all(text, escaped);
}

std::unique_ptr<connection> connection_pool::take(std::chrono::steady_clock::time_point now) {
  std::unique_ptr<connection> found;
  while (!idle_.empty() && !found) {
    auto newest = std::move(idle_.back());
    idle_.pop_back();
    if (now - newest->idle_since < keep_for_ && newest->is_quiet())
      found = std::move(newest);
  }
  gauge_ = idle_.size();
  return found;
}

void connection_pool::put(std::unique_ptr<connection> unused, std::chrono::steady_clock::time_point now) {
  unused->idle_since = now;
  idle_.push_back(std::move(unused));
  while (idle_.size() > max_kept_)
    idle_.pop_front();
  gauge_ = idle_.size();
}

} // namespace godwit::io::http
