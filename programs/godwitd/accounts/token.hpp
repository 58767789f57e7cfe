// Tokens: of sessions, of programs, of links that log in once. 258 bits of the system's randomness, so that nobody
// guesses one, and what is kept of it (its SHA-256) needs no salt.
//
// Errors: an assertion when the system has no randomness. Thread: any. Source: RFC 4648, 5 (base64url).
#pragma once

#include <string>
#include <string_view>

#include "io/http/secret_text.hpp"

namespace godwit::accounts {

inline constexpr std::size_t token_size = 43; // characters: letters, digits, - and _

[[nodiscard]] io::http::secret_text new_token();

// 64 hexadecimal digits; of anything, also of what is no token.
[[nodiscard]] std::string hash_of_token(std::string_view token);

// N bytes of the system's randomness, as hexadecimal digits.
[[nodiscard]] std::string random_hex(std::size_t bytes);

} // namespace godwit::accounts
