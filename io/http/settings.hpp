// How a client reaches its service. Nothing here holds a secret; files that do are named.
//
// There is no way to switch the verification of certificates off: a service without a certificate that everybody knows
// is given by its own CA file.
// Thread: plain values.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "io/http/error.hpp"
#include "io/http/url.hpp"

namespace godwit::io::http {

struct settings {
  std::string base_url; // https://HOST[:PORT][/PATH]; http:// without a token, or to this computer
  std::string ca_file;  // PEM; these issuers and no others. Empty: those that the system trusts
  std::string
      certificate_file;   // PEM, our own certificate and its chain, for a service that asks for one; with key_file
  std::string key_file;   // PEM, not encrypted, mode 0600
  std::string proxy;      // http://HOST:PORT; empty: none. The environment is not looked at
  std::string token_file; // mode 0600; its token goes with each request. Empty: none

  // Look-up, TCP, proxy and TLS together; an address that does not answer leaves time for the next one.
  std::chrono::milliseconds connect_timeout{5'000};
  std::chrono::milliseconds read_timeout{10'000};  // without a byte in either direction
  std::chrono::milliseconds total_timeout{60'000}; // from send() to the callback, waiting for a place included

  std::size_t max_body_bytes = 1024 * 1024; // of an answer; a request that expects more says so
  std::size_t max_under_way = 4;            // connections at a time; a long poll holds one of them
  std::size_t max_waiting = 64;             // requests for which there is no connection yet
  std::size_t max_kept = 2;                 // connections kept open without a request
  std::chrono::milliseconds keep_for{30'000};
};

// What the texts of the settings mean.
struct destination {
  url base;
  url proxy; // meaningful when has_proxy
  bool has_proxy = false;
  bool has_token = false;

  [[nodiscard]] const url& connects_to() const { return has_proxy ? proxy : base; }
};

// Refuses what can not work and what would not be safe.
[[nodiscard]] result<destination> checked(const settings& wanted);

} // namespace godwit::io::http
