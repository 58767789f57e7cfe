#include "io/http/server/server.hpp"

#include <unordered_map>
#include <utility>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>

#include "io/http/server/session.hpp"
#include "io/link/uri.hpp"

namespace godwit::io::http {

namespace asio = boost::asio;
using boost::system::error_code;
using tcp = asio::ip::tcp;

// Kept by its own handlers, which may still be on their way when the server has gone.
class server::engine : public std::enable_shared_from_this<engine> {
public:
  engine(asio::io_context& io, server_settings set, server_hooks hooks)
      : tls_(std::move(hooks.tls)), admit_(std::move(hooks.admit)), acceptor_(io), pause_(io), grace_(io),
        parts_(std::make_shared<session_parts>(session_parts{
            io, std::move(set), std::move(hooks.handle), std::move(hooks.max_body_bytes), {}, [this](session& who) {
              sessions_.erase(&who);
              tell_when_empty();
            }})) {}

  [[nodiscard]] result<void> listen();
  void stop_listening();
  void end_connections();
  void shut_down(std::chrono::milliseconds grace, std::function<void()> then);
  void leave();
  [[nodiscard]] const tcp::endpoint& where() const { return where_; }
  [[nodiscard]] server_counters counters() const {
    auto now = parts_->counters;
    now.open = sessions_.size();
    return now;
  }

private:
  [[nodiscard]] result<void> look_up();
  void accept();
  void accept_later();
  void welcome(tcp::socket accepted);
  [[nodiscard]] bool let_in(const tcp::socket& accepted, std::shared_ptr<client_place>& place) const;
  void tell_when_empty();

  std::function<std::shared_ptr<asio::ssl::context>()> tls_;
  std::function<std::shared_ptr<client_place>(const asio::ip::address& from)> admit_;
  tcp::acceptor acceptor_;
  tcp::endpoint where_; // port 0 until the first time
  asio::steady_timer pause_;
  asio::steady_timer grace_;
  std::function<void()> shut_down_; // waits until there are no connections any more
  std::shared_ptr<session_parts> parts_;
  std::unordered_map<session*, std::shared_ptr<session>> sessions_;
};

result<void> server::engine::look_up() {
  const auto& [host, port] = std::tie(parts_->set.host, parts_->set.port);
  error_code failed;
  tcp::resolver resolver(parts_->io);
  const auto found = resolver.resolve(host, std::to_string(port), tcp::resolver::passive, failed);
  if (failed || found.empty())
    return failure(errc::cannot_listen, "it is no name or address of this computer: " + failed.message(), host);
  where_ = found.begin()->endpoint();
  return {};
}

result<void> server::engine::listen() {
  if (acceptor_.is_open())
    return {};
  if (where_.port() == 0)
    if (auto looked_up = look_up(); !looked_up)
      return looked_up;
  error_code failed;
  acceptor_.open(where_.protocol(), failed);
  if (!failed)
    acceptor_.set_option(tcp::acceptor::reuse_address(true), failed);
  if (!failed)
    acceptor_.bind(where_, failed);
  if (!failed)
    acceptor_.listen(asio::socket_base::max_listen_connections, failed);
  if (failed) {
    stop_listening();
    const bool is_taken = failed == asio::error::address_in_use;
    return failure(errc::cannot_listen,
                   is_taken ? "another program listens there: end it, or name another port (0 for any free one)"
                            : "nobody can listen there: " + failed.message(),
                   link::host_and_port(where_.address().to_string(), where_.port()));
  }
  where_ = acceptor_.local_endpoint();
  accept();
  return {};
}

void server::engine::stop_listening() {
  error_code ignored; // an acceptor that can not be closed is closed
  acceptor_.close(ignored);
  pause_.cancel();
}

void server::engine::accept() {
  acceptor_.async_accept([self = shared_from_this()](const error_code& failed, tcp::socket accepted) {
    if (failed == asio::error::operation_aborted || !self->acceptor_.is_open())
      return;
    if (failed)
      return self->accept_later();
    self->welcome(std::move(accepted));
    self->accept();
  });
}

void server::engine::accept_later() {
  pause_.expires_after(accept_pause);
  pause_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (!cancelled && self->acceptor_.is_open())
      self->accept();
  });
}

bool server::engine::let_in(const tcp::socket& accepted, std::shared_ptr<client_place>& place) const {
  if (sessions_.size() >= parts_->set.max_connections)
    return false;
  if (!admit_)
    return true;
  error_code failed;
  const auto from = accepted.remote_endpoint(failed); // it may have gone already
  if (!failed)
    place = admit_(from.address());
  return place != nullptr;
}

void server::engine::welcome(tcp::socket accepted) {
  std::shared_ptr<client_place> place;
  if (!let_in(accepted, place)) {
    ++parts_->counters.turned_away;
    return; // and the socket closes
  }
  ++parts_->counters.accepted;
  error_code ignored; // then it is only slower
  accepted.set_option(tcp::no_delay(true), ignored);
  const auto who = std::make_shared<session>(parts_, std::move(accepted), std::move(place));
  sessions_.emplace(who.get(), who);
  who->start(tls_ ? tls_() : nullptr);
}

void server::engine::end_connections() {
  while (!sessions_.empty())
    sessions_.begin()->second->end(); // takes itself out
}

void server::engine::shut_down(std::chrono::milliseconds grace, std::function<void()> then) {
  stop_listening();
  shut_down_ = std::move(then);
  grace_.expires_after(grace);
  grace_.async_wait([self = shared_from_this()](const error_code& cancelled) {
    if (!cancelled)
      self->end_connections();
  });
  for (const auto& [who, kept] : sessions_)
    who->close(); // ends later
  tell_when_empty();
}

void server::engine::tell_when_empty() {
  if (!shut_down_ || !sessions_.empty())
    return;
  grace_.cancel();
  asio::post(parts_->io, std::exchange(shut_down_, nullptr)); // it may destroy the server
}

void server::engine::leave() {
  shut_down_ = nullptr;
  grace_.cancel();
  stop_listening();
  end_connections();
  parts_->ended = nullptr;
}

server::server(asio::io_context& io, server_settings set, server_hooks hooks)
    : engine_(std::make_shared<engine>(io, std::move(set), std::move(hooks))) {}
server::~server() { engine_->leave(); }

result<void> server::listen() { return engine_->listen(); }
void server::stop_listening() { engine_->stop_listening(); }
void server::end_connections() { engine_->end_connections(); }
void server::shut_down(std::chrono::milliseconds grace, std::function<void()> then) {
  engine_->shut_down(grace, std::move(then));
}
std::uint16_t server::port() const { return engine_->where().port(); }
std::string server::place() const {
  return link::host_and_port(engine_->where().address().to_string(), engine_->where().port());
}
server_counters server::counters() const { return engine_->counters(); }

} // namespace godwit::io::http
