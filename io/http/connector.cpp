#include "io/http/connector.hpp"

#include <algorithm>

#include "io/http/outcome.hpp"
#include "io/http/request_head.hpp"
#include "io/http/tls.hpp"
#include "io/link/reasons.hpp"

namespace godwit::io::http {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using tcp = asio::ip::tcp;

std::string place_of(const tcp::endpoint& at) {
  const auto host = at.address().to_string();
  return (at.address().is_v6() ? "[" + host + "]" : host) + ":" + std::to_string(at.port());
}

error connect_error(const error_code& failed, const std::string& place) {
  if (failed == asio::error::operation_aborted) // by the timer of this address
    return {errc::connect_timeout, place + ": no connection in time", {}};
  const auto code = failed == asio::error::connection_refused ? errc::refused
                    : failed == asio::error::timed_out        ? errc::connect_timeout
                                                              : errc::unreachable;
  return {code, link::remote_reason(place, failed.value()), {}};
}

error proxy_error(errc code, const std::string& what) {
  return {code, "the proxy does not let us through: " + what, {}};
}

} // namespace

connector::connector(asio::io_context& io, const destination& to, asio::ssl::context* tls,
                     std::chrono::milliseconds limit)
    : io_(io), to_(to), tls_(tls), limit_(limit), lookup_(io), address_timer_(io) {}

void connector::start(done then) {
  then_ = std::move(then);
  step_ = "looking up the host";
  lookup_.start(to_.connects_to().host, [this](const link::found_addresses& found) { looked_up(found); });
}

void connector::stop() {
  then_ = nullptr;
  address_timer_.cancel();
  if (connection_)
    connection_->close();
}

void connector::looked_up(const link::found_addresses& found) {
  if (!then_)
    return;
  if (!found)
    return fail({errc::cannot_resolve, found.error(), {}});
  addresses_.assign(found->begin(),
                    found->begin() + static_cast<std::ptrdiff_t>(std::min(found->size(), max_addresses)));
  std::ranges::reverse(addresses_);
  address_limit_ = limit_ / addresses_.size();
  try_next();
}

void connector::try_next() {
  const tcp::endpoint at(addresses_.back(), to_.connects_to().port);
  addresses_.pop_back();
  const auto place = place_of(at);
  if (to_.has_token && !to_.base.is_tls && !at.address().is_loopback())
    return fail({errc::token_in_clear, "the token would go to " + place + " in clear: use https://", {}});
  step_ = "connecting to " + place;
  connection_ = std::make_unique<connection>(io_);
  address_timer_.expires_after(address_limit_);
  address_timer_.async_wait([self = shared_from_this(), attempt = ++attempt_](const error_code& cancelled) {
    if (!cancelled && self->then_ && attempt == self->attempt_)
      self->connection_->close();
  });
  connection_->socket().async_connect(
      at, [self = shared_from_this(), place](const error_code& failed) { self->connected(failed, place); });
}

void connector::connected(const error_code& failed, const std::string& place) {
  address_timer_.cancel();
  ++attempt_; // the timer may have run out just now, with its handler on the way
  if (!then_)
    return;
  if (failed && !addresses_.empty())
    return try_next();
  if (failed)
    return fail(connect_error(failed, place));
  error_code ignored; // a little slower without it
  connection_->socket().set_option(tcp::no_delay(true), ignored);
  if (to_.has_proxy && to_.base.is_tls)
    return ask_proxy();
  begin_tls();
}

void connector::ask_proxy() {
  step_ = "waiting for the proxy";
  proxy_request_ = connect_head(to_);
  reader_rules rules;
  rules.is_connect = true;
  proxy_answer_.emplace(std::move(rules));
  connection_->write(proxy_request_, {}, [self = shared_from_this()](const error_code& failed, std::size_t) {
    if (!self->then_)
      return;
    if (failed)
      return self->fail(proxy_error(errc::connection_lost, failed.message()));
    self->read_proxy();
  });
}

void connector::read_proxy() {
  connection_->read_some(
      asio::buffer(piece_), [self = shared_from_this()](const error_code& failed, std::size_t bytes) {
        if (!self->then_)
          return;
        if (failed)
          return self->fail(proxy_error(errc::connection_lost, failed.message()));
        if (const auto taken = self->proxy_answer_->feed(std::span(self->piece_).first(bytes)); !taken)
          return self->fail(proxy_error(errc::proxy_refused, taken.error().what));
        if (!self->proxy_answer_->is_complete())
          return self->read_proxy();
        self->proxy_answered();
      });
}

void connector::proxy_answered() {
  constexpr unsigned authentication_required = 407;
  const bool has_leftover = proxy_answer_->has_leftover();
  const auto status = proxy_answer_->take().status;
  proxy_answer_.reset();
  if (status == authentication_required)
    return fail(proxy_error(errc::proxy_refused, "it wants a user and a password, which this client does not send"));
  if (status < 200 || status > 299)
    return fail(proxy_error(outcome_of(status) == outcome::transient ? errc::unreachable : errc::proxy_refused,
                            "it answered " + std::to_string(status) + " to CONNECT " + to_.base.authority()));
  if (has_leftover)
    return fail(proxy_error(errc::proxy_refused, "it sent bytes before TLS began"));
  begin_tls();
}

void connector::begin_tls() {
  if (!to_.base.is_tls)
    return finish(std::move(connection_));
  step_ = "waiting for TLS";
  SSL* const tls = connection_->begin_tls(*tls_);
  if (!expect_host(tls, to_.base.host))
    return fail({errc::tls_failed, "OpenSSL has no memory left", {}});
  connection_->shake_hands(connection::side::client,
                           [self = shared_from_this(), tls](const error_code& failed, std::size_t) {
                             if (!self->then_)
                               return;
                             if (failed)
                               return self->fail(handshake_error(tls, self->to_.base.host, failed));
                             self->finish(std::move(self->connection_));
                           });
}

void connector::fail(error why) { finish(tl::make_unexpected(std::move(why))); }

void connector::finish(result<std::unique_ptr<connection>> end) {
  address_timer_.cancel();
  const auto then = std::exchange(then_, nullptr);
  then(std::move(end));
}

} // namespace godwit::io::http
