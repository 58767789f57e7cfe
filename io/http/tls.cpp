#include "io/http/tls.hpp"

#include <string_view>

#include <boost/asio/ssl/error.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

#include "io/http/secret_file.hpp"

namespace godwit::io::http {
namespace {

namespace ssl = boost::asio::ssl;
using boost::system::error_code;

std::string reason_of(const error_code& code) {
  const char* const reason = ::ERR_reason_error_string(static_cast<unsigned long>(code.value()));
  return reason != nullptr ? reason : code.message();
}

result<void> load_issuers(ssl::context& context, const std::string& file) {
  error_code code;
  if (file.empty())
    context.set_default_verify_paths(code);
  else
    context.load_verify_file(file, code);
  if (code)
    return failure(errc::invalid_settings, "no certificates of issuers in PEM can be read there: " + reason_of(code),
                   file.empty() ? "certificates of the system" : file);
  return {};
}

// WHERE: of the key, for the sentence.
result<void> use_key(ssl::context& context, std::string_view key, const std::string& where) {
  error_code code;
  context.use_private_key(boost::asio::buffer(key.data(), key.size()), ssl::context::pem, code);
  if (code)
    return failure(errc::invalid_settings,
                   "it holds no key in PEM that fits the certificate and is not encrypted: " + reason_of(code), where);
  return {};
}

result<void> load_certificate(ssl::context& context, const settings& wanted) {
  if (wanted.certificate_file.empty())
    return {};
  error_code code;
  context.use_certificate_chain_file(wanted.certificate_file, code);
  if (code)
    return failure(errc::invalid_settings, "no certificate in PEM can be read there: " + reason_of(code),
                   wanted.certificate_file);
  const auto key = load_secret_file(wanted.key_file, max_key_bytes, errc::invalid_settings);
  if (!key)
    return tl::make_unexpected(key.error());
  return use_key(context, key->revealed(), wanted.key_file);
}

// OpenSSL would ask for a pass phrase at the terminal, and a daemon would hang there.
std::string no_pass_phrase(std::size_t, ssl::context::password_purpose) { return {}; }

std::string what_to_do(long verify_result) {
  switch (verify_result) {
  case X509_V_ERR_CERT_HAS_EXPIRED:
  case X509_V_ERR_CERT_NOT_YET_VALID:
    return "; is the clock of this computer right?";
  case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
  case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
  case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
  case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
  case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    return "; name the issuer's certificate as CA file";
  default:
    return {};
  }
}

// SIDE: ssl::context::tls_client or tls_server.
result<tls_context> new_context(ssl::context::method side, ssl::verify_mode verification) {
  auto made = std::make_unique<ssl::context>(side);
  error_code code;
  made->set_verify_mode(verification, code);
  if (!code)
    made->set_password_callback(no_pass_phrase, code);
  if (code || ::SSL_CTX_set_min_proto_version(made->native_handle(), TLS1_2_VERSION) != 1)
    return failure(errc::invalid_settings, "OpenSSL does not offer TLS 1.2 or newer", "TLS");
  ::SSL_CTX_set_options(made->native_handle(), SSL_OP_NO_RENEGOTIATION); // TLS 1.2: nothing in it that we would want
  return made;
}

} // namespace

result<tls_context> make_tls_context(const settings& wanted) {
  auto made = new_context(ssl::context::tls_client, ssl::verify_peer);
  if (!made)
    return made;
  return load_issuers(**made, wanted.ca_file).and_then([&] { return load_certificate(**made, wanted); }).map([&] {
    return *std::move(made);
  });
}

result<tls_context> make_server_tls_context(std::string_view certificate, std::string_view key) {
  auto made = new_context(ssl::context::tls_server, ssl::verify_none);
  if (!made)
    return made;
  // Of TLS 1.2 with fresh keys and without CBC; those of 1.3 are all so.
  if (::SSL_CTX_set_cipher_list((*made)->native_handle(), "ECDHE+AESGCM:ECDHE+CHACHA20") != 1)
    return failure(errc::invalid_settings, "OpenSSL does not offer AES-GCM or ChaCha20", "TLS");
  error_code code;
  (*made)->use_certificate_chain(boost::asio::buffer(certificate.data(), certificate.size()), code);
  if (code)
    return failure(errc::invalid_settings, "it is none in PEM: " + reason_of(code), "certificate of the server");
  return use_key(**made, key, "key of the server").map([&] { return *std::move(made); });
}

bool expect_host(SSL* connection, const std::string& host) {
  X509_VERIFY_PARAM* const rules = ::SSL_get0_param(connection);
  if (is_address(host))
    return ::X509_VERIFY_PARAM_set1_ip_asc(rules, host.c_str()) == 1;
  ::X509_VERIFY_PARAM_set_hostflags(rules, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS | X509_CHECK_FLAG_NEVER_CHECK_SUBJECT);
  return ::SSL_set1_host(connection, host.c_str()) == 1 &&
         ::SSL_set_tlsext_host_name(connection, host.c_str()) == 1; // NOLINT(*-cstyle-cast): a macro
}

bool is_tls_alert(const error_code& failed) { return failed.category() == boost::asio::error::get_ssl_category(); }

error alert_error(const error_code& failed) {
  switch (ERR_GET_REASON(static_cast<unsigned long>(failed.value()))) {
  case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
    return {errc::tls_failed, "the service asks for a client certificate: name its file and that of its key", {}};
  case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
  case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
  case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED:
  case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
  case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
    return {errc::tls_failed, "the service does not accept our client certificate: " + reason_of(failed), {}};
  case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION:
  case SSL_R_UNSUPPORTED_PROTOCOL:
    return {errc::tls_failed, "the service speaks no TLS 1.2 or newer: " + reason_of(failed), {}};
  case SSL_R_WRONG_VERSION_NUMBER:
  case SSL_R_HTTP_REQUEST:
    return {errc::tls_failed, "what answers there speaks no TLS: is this a port for http://?", {}};
  default:
    return {errc::tls_failed, "TLS failed: " + reason_of(failed), {}};
  }
}

error handshake_error(SSL* connection, const std::string& host, const error_code& failed) {
  const long verified = ::SSL_get_verify_result(connection);
  const bool is_refused = ERR_GET_REASON(static_cast<unsigned long>(failed.value())) == SSL_R_CERTIFICATE_VERIFY_FAILED;
  if (!is_tls_alert(failed))
    return {errc::connection_lost, "the connection broke off while TLS began: " + failed.message(), {}};
  if (!is_refused)
    return alert_error(failed);
  const std::string reason = ::X509_verify_cert_error_string(verified);
  if (verified == X509_V_ERR_HOSTNAME_MISMATCH || verified == X509_V_ERR_IP_ADDRESS_MISMATCH)
    return {errc::wrong_host, "the certificate there is not that of " + host + " (" + reason + ")", {}};
  return {errc::tls_not_verified,
          "the certificate of " + host + " can not be trusted: " + reason + what_to_do(verified),
          {}};
}

} // namespace godwit::io::http
