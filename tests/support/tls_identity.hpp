// Certificates and keys for tests, made at run time: no private key lies in the tree, and none of them ever expires
// there.
//
// Errors: a test that can not make its certificates ends with an exception. Thread: any, one at a time.
#pragma once

#include <string>
#include <vector>

namespace godwit::test {

// In PEM. A certificate of an issuer signs others; every other is for servers and clients alike.
struct tls_identity {
  std::string certificate;
  std::string key;
};

struct certificate_request {
  std::string common_name = "godwit test";
  std::vector<std::string> hosts = {}; // "DNS:localhost", "IP:127.0.0.1"
  bool is_issuer = false;
  long begins_s = -3600; // relative to now
  long ends_s = 3600;
};

// Signed by itself where ISSUER is null.
[[nodiscard]] tls_identity make_tls_identity(const certificate_request& wanted, const tls_identity* issuer = nullptr);

} // namespace godwit::test
