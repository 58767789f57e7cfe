#include "programs/godwit-sim/missions/tls_server.hpp"

#include <boost/asio/buffer.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>

namespace godwit::sim::missions {
namespace {

namespace ssl = boost::asio::ssl;
using boost::system::error_code;

std::string reason_of(const error_code& code) {
  const char* const reason = ::ERR_reason_error_string(static_cast<unsigned long>(code.value()));
  return reason != nullptr ? reason : code.message();
}

// OpenSSL would ask for a pass phrase at the terminal.
std::string no_pass_phrase(std::size_t, ssl::context::password_purpose) { return {}; }

} // namespace

tl::expected<std::unique_ptr<ssl::context>, std::string> tls_server(const identity& who) {
  auto made = std::make_unique<ssl::context>(ssl::context::tls_server);
  error_code code;
  made->set_password_callback(no_pass_phrase, code);
  if (code || ::SSL_CTX_set_min_proto_version(made->native_handle(), TLS1_2_VERSION) != 1)
    return tl::unexpected(std::string("OpenSSL does not offer TLS 1.2"));
  made->use_certificate_chain(boost::asio::buffer(who.certificate), code);
  if (code)
    return tl::unexpected("the certificate is none in PEM: " + reason_of(code));
  made->use_private_key(boost::asio::buffer(who.key), ssl::context::pem, code);
  if (code)
    return tl::unexpected("the key is none in PEM that fits the certificate and is not encrypted: " + reason_of(code));
  return made;
}

} // namespace godwit::sim::missions
