// Why an exchange with a service ended without an answer: a value for the caller, a sentence for people.
//
// A sentence says what happened, where, and what to do. It never holds a token, a key, a query or a body.
// Thread: plain values.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"

namespace godwit::io::http {

enum class errc {
  invalid_settings,   // the client was not opened: nothing was sent; of a server: a certificate or key that is none
  cannot_listen,      // the place of a server is taken, or not ours
  invalid_request,    // refused before anything was sent
  too_many,           // as many requests under way and waiting as there may be
  closing,            // the client is being destroyed
  token_file,         // missing, readable by others, not a token; read again for each request
  token_in_clear,     // the token would leave this computer without encryption
  cannot_resolve,     // the host has no address
  refused,            // nobody listens there
  unreachable,        // the network says that there is no way
  connect_timeout,    // no connection, with TLS where it is asked for, in time
  read_timeout,       // connected, but no byte in either direction for too long
  total_timeout,      // the exchange as a whole took too long
  proxy_refused,      // the proxy does not make the connection
  tls_failed,         // no common version or cipher, an alert, a certificate of ours that is missing or refused
  tls_not_verified,   // the certificate of the service can not be trusted: expired, unknown issuer ...
  wrong_host,         // the certificate is good, and of somebody else
  connection_lost,    // reset or closed before a byte of the answer
  truncated,          // closed in the middle of the answer
  malformed,          // what came is not HTTP/1
  header_too_large,   // the head of the answer is above its bound
  body_too_large,     // the body of the answer is above the bound of the request
  encoded,            // compressed, though only plain bytes were accepted
  wrong_content_type, // not of the type that the request expects
  redirect,           // the answer is elsewhere; a client with a token does not follow
  cancelled,          // by the caller, by its sink, or because the client was destroyed
};

GODWIT_ENUM_NAMES(errc, invalid_settings, cannot_listen, invalid_request, too_many, closing, token_file, token_in_clear,
                  cannot_resolve, refused, unreachable, connect_timeout, read_timeout, total_timeout, proxy_refused,
                  tls_failed, tls_not_verified, wrong_host, connection_lost, truncated, malformed, header_too_large,
                  body_too_large, encoded, wrong_content_type, redirect, cancelled);

struct error {
  errc code{};
  std::string what;  // what is wrong and what to do about it
  std::string where; // "https://missions.example:8443/missions/7", or the file concerned; empty while nobody said

  // "https://missions.example:8443/missions/7: nobody listens there (connection refused): ..."
  [[nodiscard]] std::string message() const { return where.empty() ? what : where + ": " + what; }
  bool operator==(const error&) const = default;
};

template <class T>
using result = tl::expected<T, error>;

[[nodiscard]] inline tl::unexpected<error> failure(errc code, std::string what, std::string where = {}) {
  return tl::unexpected<error>(error{code, std::move(what), std::move(where)});
}

// True when the same request may well succeed later without anybody doing something: the network, or a service that
// starts again. False when a person has to act first.
[[nodiscard]] bool is_transient(errc code);

} // namespace godwit::io::http
