#include "io/mqtt/connection.hpp"

#include <array>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <openssl/crypto.h>

#include "io/http/connector.hpp"
#include "io/http/secret_file.hpp"
#include "io/http/tls.hpp"
#include "io/mqtt/session.hpp"

namespace godwit::io::mqtt {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr std::size_t max_password_bytes = 4'096;
// What the kernel keeps of ours. Its own choice are megabytes, after which what is live grows old.
constexpr int kernel_buffer_bytes = 32 * 1024;
// To each address of the broker; the rest of opening_limit is for the look-up and TLS.
constexpr std::chrono::seconds address_limit{15};

failure failure_of(http::errc code) {
  switch (code) {
  case http::errc::cannot_resolve:
    return failure::not_resolved;
  case http::errc::tls_failed:
  case http::errc::tls_not_verified:
  case http::errc::wrong_host:
    return failure::certificate;
  default:
    return failure::unreachable;
  }
}

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// One end of line after the password is cut off.
http::result<http::secret_text> load_password(const std::string& file) {
  auto read = http::load_secret_file(file, max_password_bytes, http::errc::token_file);
  if (read)
    read->cut_to(std::min(read->revealed().size(), read->revealed().find_first_of("\r\n")));
  return read;
}

} // namespace

class connection::inner : public std::enable_shared_from_this<inner> {
public:
  inner(asio::io_context& io, connection_settings settings, message will, listener to)
      : io_(io), settings_(std::move(settings)),
        to_{{settings_.broker.uses_tls, settings_.broker.host, settings_.broker.port, {}}, {}, false, false},
        session_({settings_.client_id, settings_.username, settings_.keep_alive_s}, std::move(will)), timer_(io),
        listener_(std::move(to)) {}

  void start();
  void publish(const message& what, std::uint64_t token);
  void end();
  [[nodiscard]] bool wait_for_end(std::chrono::milliseconds patience);

  void stop_listening() {
    const std::lock_guard guard(listener_mutex_);
    is_listened_to_ = false;
  }

private:
  [[nodiscard]] bool read_files();
  void opened(http::result<std::unique_ptr<http::connection>> made);
  void read();
  void pump();
  void write(std::string batch);
  void wait();
  void on_transport_failed(const error_code& failed);
  void finish();
  void report(const session_event& event);
  template <class F>
  void call(const F& what) {
    const std::lock_guard guard(listener_mutex_);
    if (is_listened_to_)
      what();
  }

  asio::io_context& io_;
  const connection_settings settings_;
  const http::destination to_;
  http::tls_context tls_;
  std::optional<http::secret_text> password_;
  session session_;
  asio::steady_timer timer_;
  std::shared_ptr<http::connector> connector_;
  std::unique_ptr<http::connection> transport_;
  std::array<char, max_packet_bytes> piece_{};
  std::string batch_;
  bool is_finished_ = false;

  std::mutex listener_mutex_; // held while the listener is called
  bool is_listened_to_ = true;
  listener listener_;

  std::mutex end_mutex_;
  std::condition_variable end_changed_;
  bool has_ended_ = false;
};

// -- opening --------------------------------------------------------------------------------------

bool connection::inner::read_files() {
  if (!settings_.username.empty() && !settings_.password_file.empty()) {
    auto password = load_password(settings_.password_file);
    if (!password) {
      session_.on_failed(failure::unusable, password.error().message());
      return false;
    }
    password_ = *std::move(password);
  }
  if (!settings_.broker.uses_tls)
    return true;
  http::settings files;
  files.ca_file = settings_.ca_file;
  files.certificate_file = settings_.certificate_file;
  files.key_file = settings_.key_file;
  auto tls = http::make_tls_context(files);
  if (!tls) {
    session_.on_failed(failure::unusable, tls.error().message());
    return false;
  }
  tls_ = *std::move(tls);
  return true;
}

void connection::inner::start() {
  if (session_.is_over() || !read_files())
    return pump();
  connector_ = std::make_shared<http::connector>(io_, to_, tls_.get(), address_limit);
  timer_.expires_after(opening_limit);
  timer_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (cancelled || self->transport_ || self->is_finished_)
      return;
    self->session_.on_failed(failure::unreachable, "there is no connection after 25 s: " + self->connector_->step());
    self->pump();
  });
  connector_->start([self = shared_from_this()](auto made) { self->opened(std::move(made)); });
}

void connection::inner::opened(http::result<std::unique_ptr<http::connection>> made) {
  if (!made) {
    session_.on_failed(failure_of(made.error().code), "there is no connection: " + made.error().what);
    return pump();
  }
  transport_ = *std::move(made);
  error_code ignored; // what is live is then a little older where the network is slow
  transport_->socket().set_option(asio::socket_base::send_buffer_size(kernel_buffer_bytes), ignored);
  const auto revealed = password_ ? password_->revealed() : std::string_view();
  session_.begin(password_ ? &revealed : nullptr, now_ms());
  password_.reset();
  read();
  pump();
}

// -- reading and writing --------------------------------------------------------------------------

void connection::inner::read() {
  transport_->read_some(asio::buffer(piece_), [self = shared_from_this()](const error_code& failed, std::size_t bytes) {
    if (self->is_finished_)
      return;
    if (failed)
      self->on_transport_failed(failed);
    else
      self->session_.on_bytes({self->piece_.data(), bytes}, now_ms());
    self->pump();
    if (!failed && !self->is_finished_)
      self->read();
  });
}

void connection::inner::write(std::string batch) {
  batch_ = std::move(batch);
  transport_->write(batch_, {}, [self = shared_from_this()](const error_code& failed, std::size_t) {
    ::OPENSSL_cleanse(self->batch_.data(), self->batch_.size());
    if (self->is_finished_)
      return;
    if (failed)
      self->on_transport_failed(failed);
    else
      self->session_.on_written(now_ms());
    self->pump();
  });
}

void connection::inner::on_transport_failed(const error_code& failed) {
  if (http::is_tls_alert(failed))
    return session_.on_failed(failure::certificate, http::alert_error(failed).what);
  const bool is_closed = failed == asio::error::eof || failed == asio::ssl::error::stream_truncated;
  if (session_.is_open())
    session_.on_failed(failure::lost,
                       "the connection was lost" + (is_closed ? std::string() : ": " + failed.message()));
  else
    session_.on_failed(failure::unreachable,
                       "the connection was closed before an answer to CONNECT: is it a broker of MQTT?");
}

// After each change of the session: what it has to report, to write, and to wait for.
void connection::inner::pump() {
  for (const auto& event : session_.take_events())
    report(event);
  if (session_.is_over())
    return finish();
  if (!transport_)
    return;
  if (auto batch = session_.take_batch(now_ms()); !batch.empty())
    write(std::move(batch));
  wait();
}

void connection::inner::wait() {
  const auto left_ms = std::max<std::int64_t>(0, session_.next_due_ms() - now_ms());
  timer_.expires_after(std::chrono::milliseconds(left_ms));
  timer_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (cancelled || self->is_finished_)
      return;
    self->session_.on_time(now_ms());
    self->pump();
  });
}

void connection::inner::report(const session_event& event) {
  if (const auto* const m = std::get_if<session_opened>(&event))
    call([&] { listener_.opened(m->max_packet_bytes); });
  else if (const auto* const taken = std::get_if<session_published>(&event))
    call([&] { listener_.published(taken->token); });
  else if (const auto* const end = std::get_if<session_closed>(&event))
    call([&] { listener_.closed(end->why, end->sentence); });
}

// -- from any thread, and the end -----------------------------------------------------------------

void connection::inner::publish(const message& what, std::uint64_t token) {
  asio::post(io_, [self = shared_from_this(), what, token] {
    if (self->is_finished_)
      return;
    self->session_.publish(what, token, now_ms());
    self->pump();
  });
}

void connection::inner::end() {
  stop_listening();
  asio::post(io_, [self = shared_from_this()] {
    if (self->is_finished_)
      return;
    self->session_.end(now_ms());
    self->pump();
  });
}

void connection::inner::finish() {
  if (std::exchange(is_finished_, true))
    return;
  timer_.cancel();
  if (connector_)
    connector_->stop();
  if (transport_)
    transport_->close();
  const std::lock_guard guard(end_mutex_);
  has_ended_ = true;
  end_changed_.notify_all();
}

bool connection::inner::wait_for_end(std::chrono::milliseconds patience) {
  std::unique_lock lock(end_mutex_);
  return end_changed_.wait_for(lock, patience, [this] { return has_ended_; });
}

// -- connection -----------------------------------------------------------------------------------

connection::connection(asio::io_context& io, connection_settings settings, message will, listener to)
    : inner_(std::make_shared<inner>(io, std::move(settings), std::move(will), std::move(to))) {
  asio::post(io, [shared = inner_] { shared->start(); });
}

void connection::publish(const message& what, std::uint64_t token) { inner_->publish(what, token); }

void connection::end() { inner_->end(); }

bool connection::wait_for_end(std::chrono::milliseconds patience) { return inner_->wait_for_end(patience); }

} // namespace godwit::io::mqtt
