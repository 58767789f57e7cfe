// TLS as client and server speak it: 1.2 or newer. The client verifies the other side, and checks its name or address
// against the alternative names of its certificate and not against its common name; the server asks for no certificate.
//
// Errors: as values. Thread: a context is made by one thread and used by one. Reads files.
// Source: OpenSSL 3.0 SSL_CTX_set_min_proto_version(3), SSL_set1_host(3), SSL_get_verify_result(3); RFC 9525, 2; RFC
// 6066, 3 (the name of a server that is sent along is never an address).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/ssl/context.hpp>
#include <boost/system/error_code.hpp>

#include "io/http/error.hpp"
#include "io/http/settings.hpp"

namespace godwit::io::http {

using tls_context = std::unique_ptr<boost::asio::ssl::context>;

[[nodiscard]] result<tls_context> make_tls_context(const settings& wanted);
// Both in PEM: the certificate with its chain; the key not encrypted.
[[nodiscard]] result<tls_context> make_server_tls_context(std::string_view certificate, std::string_view key);

// Before the handshake: whose certificate it must be. False: OpenSSL has no memory.
[[nodiscard]] bool expect_host(SSL* connection, const std::string& host);

// After a handshake that failed.
[[nodiscard]] error handshake_error(SSL* connection, const std::string& host, const boost::system::error_code& failed);

// True for what the other side or OpenSSL says about TLS itself, as against the connection below it.
[[nodiscard]] bool is_tls_alert(const boost::system::error_code& failed);
[[nodiscard]] error alert_error(const boost::system::error_code& failed);

} // namespace godwit::io::http
