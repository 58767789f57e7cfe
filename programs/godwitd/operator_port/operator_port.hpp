// The port for programs and for the page of operators: HTTP and WebSocket on one thread of its own.
//
//   clients ──> client_table ──> io/http server (TLS) ──> router ──> routes: view_api, stream_api, ...
//
// It shows, and what it hands on is for the actors to judge. Nothing of the flight waits for it, and a port that is
// taken is no reason not to fly. Errors: open, as sentences with what to do. Thread: open and close by the owner.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <tl/expected.hpp>

#include "io/http/server/settings.hpp"
#include "io/prometheus/text.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "programs/godwitd/operator_port/settings.hpp"

namespace godwit::operator_port {

// The fingerprint of the certificate that counts now, or why it stays as it was.
using certificate_listener = std::function<void(const tl::expected<std::string, std::string>& now)>;

// Whom the port asks, in its thread.
struct port_guards {
  std::function<void(const std::string& from)> on_other_origin = {}; // a page of another site has asked
  gate let_in = {}; // THEN may be called in any thread; none: nobody looks from another computer
  certificate_listener on_certificate = {};
};

class port {
public:
  port();
  ~port(); // as close()
  port(const port&) = delete;
  port& operator=(const port&) = delete;

  // For the parts of the API, which live in it.
  [[nodiscard]] boost::asio::io_context& context();
  // ROUTES of all parts. After an error it may be tried again.
  [[nodiscard]] tl::expected<void, std::string> open(const settings& wanted, route_list routes, port_guards by = {});
  // Runs WHAT in the thread of the port after the end of all connections, then ends that thread.
  void close(const std::function<void()>& what = {});

  [[nodiscard]] std::string place() const; // "127.0.0.1:8088"; empty: it is not open
  [[nodiscard]] std::string url() const;   // "https://0.0.0.0:8443"; the same
  // Of the certificate, SHA-256: "3A:5F:..."; empty without TLS.
  // As it opened; later ones are told to the listener.
  [[nodiscard]] std::string fingerprint() const;
  [[nodiscard]] bool is_certificate_new() const; // our own, made at this start

  // Looked at each second, and here whatever the files look like. Any thread.
  void read_certificate_anew();
  // The WebSockets that came with it end. Any thread.
  void end_session(const std::string& session);
  // What it has counted. In the thread of the port.
  void append_metrics(io::prometheus::text_writer& out) const;

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::operator_port
