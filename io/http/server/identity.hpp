// Who a server of TLS is: its certificate and the key of it, in PEM.
//
//   const auto kept = keep_identity("godwit.tls", {"drone.local", "127.0.0.1"}, addresses_of_this_computer);
//
// A computer in the field has no issuer who would sign for it, and often a clock that is years behind. So a server can
// make its own: a new key (EC P-256) and a certificate that is signed by it, valid from 2020 to the end of 2049. Who
// connects compares its fingerprint once.
//
// Errors: values that name the file and the remedy. Blocks on the disk. Thread: any. Source: RFC 5280, 4.2.1.3, 4.2.1.6
// and 4.2.1.12; RFC 5915; SHA-256 over the DER form is what browsers show as fingerprint.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/http/error.hpp"
#include "io/http/secret_file.hpp"

namespace godwit::io::http {

inline constexpr std::size_t max_certificate_bytes = 64 * 1024; // a chain of five with RSA 4096 has 12 kB

struct server_identity {
  std::string certificate; // with its chain
  secret_text key;
};

// NAMES: of this computer, and its addresses without brackets.
[[nodiscard]] result<server_identity> make_identity(const std::vector<std::string>& names);

// The key's file is of mode 0600. Whether both belong together is seen when they are used (tls.hpp).
[[nodiscard]] result<server_identity> load_identity(const std::string& certificate_file, const std::string& key_file);

struct kept_identity {
  server_identity identity;
  bool is_new = false; // its fingerprint is another one than before
};
// The own one in FILE (mode 0600, key and certificate), which is made when it is not there. A certificate that lacks
// one of NAMES is made anew, with the same key; MORE_NAMES go into one that is made, and are not missed later.
[[nodiscard]] result<kept_identity> keep_identity(const std::string& file, const std::vector<std::string>& names,
                                                  const std::vector<std::string>& more_names);

// "3A:5F:...", 32 bytes; empty: there is no certificate in it.
[[nodiscard]] std::string fingerprint_of(std::string_view certificate);

} // namespace godwit::io::http
