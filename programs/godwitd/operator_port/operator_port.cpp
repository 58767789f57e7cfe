#include "programs/godwitd/operator_port/operator_port.hpp"

#include <atomic>
#include <chrono>
#include <optional>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "io/http/server/server.hpp"
#include "io/link/io_thread.hpp"
#include "programs/godwitd/operator_port/certificate.hpp"
#include "programs/godwitd/operator_port/client_table.hpp"

namespace godwit::operator_port {
namespace {

using io::http::header;

// Of each answer: it is no page, is kept by nobody, and is shown in nobody's frame. OWASP, "HTTP Security Response
// Headers".
std::vector<header> security_headers() {
  return {
      {"Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
}

// Whatever a route asks for.
constexpr std::size_t max_body_bytes = 1024 * 1024;
// A browser keeps six connections, and an address has eight places: those that say nothing are free again soon.
constexpr std::chrono::seconds idle_timeout{5};
constexpr std::chrono::seconds certificate_look{1};
constexpr std::chrono::seconds handshake_timeout{5}; // two ways there and back, of which each may be repeated

io::http::server_settings settings_of(const settings& wanted) {
  io::http::server_settings result;
  result.host = wanted.host;
  result.port = wanted.port;
  result.headers = security_headers();
  result.max_connections = 2 * wanted.max_clients; // client_table has the bound; some of these are about to end
  result.max_body_bytes = max_body_bytes;
  result.idle_timeout = idle_timeout;
  result.handshake_timeout = handshake_timeout;
  return result;
}

struct counter_row {
  const char* name;
  const char* help;
  std::uint64_t io::http::server_counters::*value;
};

constexpr counter_row counter_rows[] = {
    {"godwit_operator_port_connections_total", "Connections of clients.", &io::http::server_counters::accepted},
    {"godwit_operator_port_turned_away_total", "Connections above a bound.", &io::http::server_counters::turned_away},
    {"godwit_operator_port_handshakes_total", "Handshakes of TLS that went well.",
     &io::http::server_counters::handshakes},
    {"godwit_operator_port_handshakes_failed_total", "Handshakes of TLS that did not.",
     &io::http::server_counters::handshakes_failed},
    {"godwit_operator_port_handshake_timeouts_total", "Handshakes of TLS that took too long.",
     &io::http::server_counters::handshake_timeouts},
    {"godwit_operator_port_upgraded_total", "Connections that became WebSockets.",
     &io::http::server_counters::upgraded},
    {"godwit_operator_port_requests_total", "Requests.", &io::http::server_counters::requests},
    {"godwit_operator_port_malformed_total", "Requests that are not HTTP.", &io::http::server_counters::malformed},
    {"godwit_operator_port_lost_total", "Clients that went before they had their answer.",
     &io::http::server_counters::lost},
};

} // namespace

struct port::parts {
  io::link::io_thread thread;
  std::atomic<bool> is_running = false;
  std::optional<router> routes;
  std::shared_ptr<client_table> clients;
  std::optional<certificate> tls;                    // none: plain HTTP. From open() on in the thread
  boost::asio::steady_timer looks{thread.context()}; // at the files of the certificate
  certificate_listener on_certificate;
  std::unique_ptr<io::http::server> server;

  void guard(port_guards by);
  void look_at_certificate(bool even_if_same);
  void look_later();
};

void port::parts::guard(port_guards by) {
  routes->on_other_origin(std::move(by.on_other_origin));
  if (!by.let_in)
    return;
  routes->guard([this, let_in = std::move(by.let_in)](const server_request& asked, responder answer,
                                                      const std::function<void(responder)>& then) {
    let_in(asked, std::move(answer), [this, then](responder whose) {
      boost::asio::post(thread.context(),
                        [then, kept = std::make_shared<responder>(std::move(whose))] { then(std::move(*kept)); });
    });
  });
}

void port::parts::look_at_certificate(bool even_if_same) {
  if (!tls)
    return;
  const auto read = tls->read_anew(even_if_same);
  if (on_certificate && (!read || *read || even_if_same))
    on_certificate(read.map([this](bool) { return tls->fingerprint(); }));
}

void port::parts::look_later() {
  looks.expires_after(certificate_look);
  looks.async_wait([this](const boost::system::error_code& cancelled) {
    if (cancelled)
      return;
    look_at_certificate(false);
    look_later();
  });
}

port::port() : parts_(std::make_unique<parts>()) {}
port::~port() { close(); }

boost::asio::io_context& port::context() { return parts_->thread.context(); }

tl::expected<void, std::string> port::open(const settings& wanted, route_list routes, port_guards by) {
  auto& p = *parts_;
  if (wanted.uses_tls) {
    auto loaded = certificate::load(wanted);
    if (!loaded)
      return tl::make_unexpected(std::move(loaded.error()));
    p.tls = *std::move(loaded);
  }
  p.routes.emplace(std::move(routes), wanted.hosts, wanted.uses_tls);
  p.on_certificate = std::move(by.on_certificate);
  p.guard(std::move(by));
  p.clients = std::make_shared<client_table>(wanted.max_clients, wanted.max_clients_an_address);
  io::http::server_hooks hooks;
  hooks.handle = [&p](server_request asked, responder answer) {
    p.routes->answer(std::move(asked), std::move(answer));
  };
  hooks.max_body_bytes = [&p](std::string_view method, std::string_view target) {
    return p.routes->max_body_bytes(method, target);
  };
  hooks.admit = [clients = p.clients](const boost::asio::ip::address& from) { return clients->admit(from); };
  if (p.tls)
    hooks.tls = [&p] { return p.tls->context(); };
  p.server = std::make_unique<io::http::server>(p.thread.context(), settings_of(wanted), std::move(hooks));
  if (const auto listening = p.server->listen(); !listening) {
    p.server.reset();
    return tl::make_unexpected(listening.error().message());
  }
  if (p.tls)
    p.look_later();
  p.thread.start();
  p.is_running = true;
  return {};
}

void port::read_certificate_anew() {
  if (auto& p = *parts_; p.is_running)
    boost::asio::post(p.thread.context(), [&p] { p.look_at_certificate(true); });
}

void port::end_session(const std::string& session) {
  if (auto& p = *parts_; p.is_running)
    boost::asio::post(p.thread.context(), [clients = p.clients, session] { clients->end_session(session); });
}

void port::close(const std::function<void()>& what) {
  auto& p = *parts_;
  if (!p.is_running.exchange(false))
    return;
  p.thread.run_inside([&] {
    p.looks.cancel();
    p.server.reset();
    if (what)
      what();
  });
  p.thread.stop();
}

std::string port::place() const { return parts_->server ? parts_->server->place() : std::string(); }

std::string port::url() const {
  return parts_->server ? (parts_->tls ? "https://" : "http://") + place() : std::string();
}

std::string port::fingerprint() const { return parts_->tls ? parts_->tls->fingerprint() : std::string(); }
bool port::is_certificate_new() const { return parts_->tls && parts_->tls->is_new(); }

void port::append_metrics(io::prometheus::text_writer& out) const {
  using io::prometheus::metric_kind;
  const auto& p = *parts_;
  const auto counted = p.server->counters();
  out.one("godwit_operator_port_clients", metric_kind::gauge, "Clients of the operator's port.", p.clients->now());
  out.one("godwit_operator_port_gave_way_total", metric_kind::counter,
          "Connections without a session that were ended for a new one.", p.clients->gave_way());
  for (const auto& each : counter_rows)
    out.one(each.name, metric_kind::counter, each.help, counted.*each.value);
  const auto& refused = p.routes->counts();
  out.begin("godwit_operator_port_refused_total", metric_kind::counter, "Requests that the port did not take.");
  out.add(refused.other_host, {{"reason", "host"}});
  out.add(refused.other_origin, {{"reason", "origin"}});
  out.add(refused.no_such_path, {{"reason", "path"}});
  out.add(refused.no_such_method, {{"reason", "method"}});
  out.add(refused.not_let_in, {{"reason", "session"}});
}

} // namespace godwit::operator_port
