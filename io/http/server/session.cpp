#include "io/http/server/session.hpp"

#include <span>
#include <string_view>
#include <utility>

#include <boost/asio/ip/address.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include "io/http/server/response_head.hpp"
#include "io/http/tls.hpp"

namespace godwit::io::http {

namespace asio = boost::asio;

namespace {

constexpr std::string_view tls_sentence =
    R"({"type":"about:blank","title":"Bad Request","status":400,"detail":"This port speaks TLS: ask with https://."})";

std::string text_of(asio::ip::address address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
  return address.to_string();
}

bool is_plain_http(const boost::system::error_code& failed) {
  return is_tls_alert(failed) && ERR_GET_REASON(static_cast<unsigned long>(failed.value())) == SSL_R_HTTP_REQUEST;
}

} // namespace

session::session(std::shared_ptr<session_parts> parts, asio::ip::tcp::socket accepted,
                 std::shared_ptr<client_place> place)
    : parts_(std::move(parts)), connection_(std::make_unique<connection>(std::move(accepted))), watchdog_(parts_->io),
      reader_(parts_->set, parts_->limit) {
  connection_->occupy(std::move(place));
  note_addresses();
}

void session::start(std::shared_ptr<asio::ssl::context> tls) {
  if (tls == nullptr)
    return read();
  watch(clock::now() + parts_->set.handshake_timeout, &server_counters::handshake_timeouts);
  connection_->begin_tls(*tls);
  connection_->keep(std::move(tls));
  connection_->shake_hands(connection::side::server, [self = shared_from_this()](const error_code& failed, auto) {
    if (self->phase_ == phase::ended)
      return;
    if (!failed) {
      ++self->parts_->counters.handshakes;
      return self->read();
    }
    ++self->parts_->counters.handshakes_failed;
    if (is_plain_http(failed))
      return self->refuse_plain();
    self->end();
  });
}

void session::note_addresses() {
  boost::system::error_code gone; // then nobody hears an answer
  const auto& socket = connection_->socket();
  if (const auto other = socket.remote_endpoint(gone); !gone)
    from_ = text_of(other.address());
  if (const auto own = socket.local_endpoint(gone); !gone)
    to_ = text_of(own.address());
}

// In clear, since the client speaks nothing else.
void session::refuse_plain() {
  phase_ = phase::writing;
  is_last_ = true;
  head_ = head_of(problem_response(400, {}), tls_sentence.size());
  watch(clock::now() + parts_->set.write_timeout, &server_counters::write_timeouts);
  connection_->write_plain(head_, tls_sentence, [self = shared_from_this()](const error_code& failed, auto) {
    if (self->phase_ != phase::ended)
      failed ? self->end() : self->send_goodbye();
  });
}

// Whoever waits for something asks for it before or after: nothing runs in between. A later call takes the place of an
// earlier one.
void session::watch(clock::time_point until, std::uint64_t server_counters::*counted) {
  watchdog_.expires_at(until);
  watchdog_.async_wait([self = shared_from_this(), number = ++watch_, counted](const error_code& cancelled) {
    if (cancelled || number != self->watch_)
      return;
    if (counted != nullptr)
      ++(self->parts_->counters.*counted);
    self->end();
  });
}

void session::stop_watching() {
  ++watch_;
  watchdog_.cancel();
}

void session::watch_reading() {
  const auto& set = parts_->set;
  if (!reader_.has_begun())
    return watch(clock::now() + set.idle_timeout, &server_counters::idle_timeouts);
  if (!begun_at_)
    begun_at_ = clock::now();
  if (!reader_.has_head())
    return watch(*begun_at_ + set.head_timeout, &server_counters::head_timeouts);
  const std::chrono::seconds earned(reader_.body_bytes() / set.min_bytes_per_s);
  watch(*begun_at_ + set.head_timeout + set.body_timeout + earned, &server_counters::body_timeouts);
}

void session::read() {
  phase_ = phase::reading;
  watch_reading();
  if (!is_reading_)
    start_reading();
}

void session::start_reading() {
  is_reading_ = true;
  connection_->read_some(asio::buffer(bytes_), [self = shared_from_this()](const error_code& failed, auto bytes) {
    self->is_reading_ = false;
    self->have_read(failed, bytes);
  });
}

void session::have_read(const error_code& failed, std::size_t bytes) {
  if (phase_ == phase::reading && !failed)
    return go_on(reader_.feed(std::span(bytes_).first(bytes)));
  if (phase_ == phase::reading || (phase_ == phase::handling && failed))
    return lost();
  if (phase_ == phase::closing)
    return failed ? end() : drain();
  if (failed)
    is_last_ = true; // an answer that is going out may still arrive
  else
    early_bytes_ = bytes;
}

void session::go_on(progress how_far) {
  switch (how_far) {
  case progress::more:
    return reader_.take_continue() ? send_continue() : read();
  case progress::complete:
    return handle();
  case progress::refused:
    return refuse();
  }
}

void session::send_continue() {
  watch(clock::now() + parts_->set.write_timeout, &server_counters::write_timeouts);
  connection_->write("HTTP/1.1 100 Continue\r\n\r\n", {}, [self = shared_from_this()](const error_code& failed, auto) {
    if (self->phase_ != phase::ended)
      failed ? self->lost() : self->read();
  });
}

void session::handle() {
  stop_watching(); // how long an answer may take is the business of whoever gives it
  phase_ = phase::handling;
  ++request_number_;
  ++parts_->counters.requests;
  is_last_ = is_last_ || request_number_ == parts_->set.max_requests || !reader_.can_be_kept();
  auto asked = reader_.take();
  asked.from = from_;
  asked.to = to_;
  asked.place = connection_->place();
  keeps_unread_ = false;
  is_head_only_ = asked.method == "HEAD";
  parts_->handle(std::move(asked), {weak_from_this(), request_number_, parts_->io.get_executor()});
  look_for_end();
}

void session::refuse() {
  const auto& [status, sentence] = reader_.refusal();
  auto& counters = parts_->counters;
  ++(status == 400 ? counters.malformed : status == 413 ? counters.body_too_large : counters.head_too_large);
  is_last_ = true;
  ++request_number_;
  respond(problem_response(status, sentence));
}

void session::look_for_end() {
  if (phase_ == phase::handling && !keeps_unread_ && !is_reading_ && early_bytes_ == 0 && reader_.unread().empty())
    start_reading();
}

bool session::awaits(std::uint64_t request_number) const {
  return request_number == request_number_ && (phase_ == phase::handling || phase_ == phase::writing);
}

// What the handler has said itself counts.
std::string session::head_of(const server_response& what, std::optional<std::uint64_t> body_bytes) const {
  server_response head{what.status, what.content_type, {}, what.headers};
  for (const auto& each : parts_->set.headers)
    if (what.headers.empty() || find_header(what.headers, each.name).empty())
      head.headers.push_back(each);
  return response_head(head, body_bytes, is_last_);
}

void session::respond(const server_response& whole) {
  is_head_only_ = is_head_only_ || has_no_body(whole.status);
  owed_ = 0;
  send(head_of(whole, whole.body.size()), whole.body, [this] { answered(); });
}

void session::begin_answer(const server_response& what, std::optional<std::uint64_t> body_bytes, responder::next then) {
  is_head_only_ = is_head_only_ || has_no_body(what.status);
  is_last_ = is_last_ || !body_bytes;
  owed_ = is_head_only_ ? std::nullopt : body_bytes;
  head_ = head_of(what, body_bytes);
  write(what.body, std::move(then));
}

void session::write(std::string bytes, responder::next then) {
  if (phase_ != phase::handling || (owed_ && bytes.size() > *owed_))
    return abort();
  if (owed_)
    *owed_ -= bytes.size();
  send(std::exchange(head_, {}), std::move(bytes), [this, then = std::move(then)] {
    phase_ = phase::handling;
    look_for_end();
    then();
  });
}

void session::finish() { owed_.value_or(0) == 0 && phase_ == phase::handling ? answered() : abort(); }

void session::abort() {
  ++parts_->counters.aborted;
  connection_->reset();
  end();
}

void session::upgrade(const responder::taker& then) {
  if (is_reading_)
    return abort();
  ++parts_->counters.upgraded;
  auto taken = std::move(connection_);
  if (const auto place = taken->place().lock())
    place->is_websocket = true;
  const auto self = shared_from_this(); // it has what the client said early
  end();
  then(std::move(taken), std::string(reader_.unread()));
}

void session::send(std::string head, std::string body, responder::next then) {
  phase_ = phase::writing;
  head_ = std::move(head);
  body_ = is_head_only_ ? std::string() : std::move(body);
  sent_ = 0;
  then_ = std::move(then);
  send_piece();
}

void session::send_piece() {
  watch(clock::now() + parts_->set.write_timeout, &server_counters::write_timeouts);
  const auto head = sent_ == 0 ? std::string_view(head_) : std::string_view();
  const auto piece = std::string_view(body_).substr(sent_, piece_bytes);
  connection_->write(head, piece, [self = shared_from_this(), size = piece.size()](const error_code& failed, auto) {
    if (self->phase_ == phase::ended)
      return;
    if (failed)
      return self->lost();
    self->sent_ += size;
    self->have_sent();
  });
}

void session::have_sent() {
  if (sent_ < body_.size())
    return send_piece();
  stop_watching();
  head_.clear();
  std::exchange(then_, nullptr)();
}

void session::answered() {
  ++parts_->counters.answered;
  on_gone_ = nullptr;
  begun_at_.reset();
  if (is_last_)
    return send_goodbye();
  auto how_far = reader_.next();
  if (how_far == progress::more && early_bytes_ != 0)
    how_far = reader_.feed(std::span(bytes_).first(std::exchange(early_bytes_, 0)));
  go_on(how_far);
}

void session::send_goodbye() {
  phase_ = phase::closing;
  watch(clock::now() + parts_->set.close_timeout, nullptr);
  connection_->shut_down([self = shared_from_this()](const error_code&, auto) { self->drain(); });
}

void session::drain() {
  if (phase_ == phase::ended || is_reading_) // a second read would not hear of the end
    return;
  connection_->read_raw(asio::buffer(bytes_), [self = shared_from_this()](const error_code& failed, auto) {
    failed ? self->end() : self->drain();
  });
}

void session::close() {
  is_last_ = true;
  if (phase_ == phase::reading)
    send_goodbye();
}

void session::lost() {
  if (phase_ != phase::reading || reader_.has_begun())
    ++parts_->counters.lost;
  end();
}

void session::end() {
  if (std::exchange(phase_, phase::ended) == phase::ended)
    return;
  stop_watching();
  if (connection_)
    connection_->close();
  then_ = nullptr;
  const auto gone = std::exchange(on_gone_, nullptr);
  const auto self = shared_from_this();
  if (parts_->ended)
    parts_->ended(*this);
  if (gone)
    gone();
}

} // namespace godwit::io::http
