// A configuration or a status as somebody else may see it.
//
// Left out are the values of names that mean a secret (token, password, secret, key, but not the names of files), and
// of addresses the user, the password and what stands behind a question mark. Thread: pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace godwit::programs {

[[nodiscard]] nlohmann::json without_secrets(nlohmann::json document);

// "https://ann:pw@host/x?token=1" -> "https://(left out)@host/x?(left out)"
[[nodiscard]] std::string address_without_secrets(const std::string& text);

} // namespace godwit::programs
