// A password as it is kept: scrypt over it and a salt of its own, with the cost beside it, so that the cost can rise.
//
// At the usual cost it takes 32 MiB of memory and some tenths of a second: one at a time, and never in an actor.
// Errors: false, also where the library refuses. Thread: any; blocks. Source: RFC 7914; OWASP Password Storage Cheat
// Sheet (N = 2^15, r = 8, p = 3).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/fields/field_table.hpp"
#include "io/http/secret_file.hpp"

namespace godwit::accounts {

inline constexpr std::size_t min_password = 8;   // bytes
inline constexpr std::size_t max_password = 256; // bytes; longer ones are refused unread

struct password_hash {
  std::string salt; // hexadecimal
  std::string hash; // hexadecimal
  std::uint64_t n = 32'768;
  std::uint32_t r = 8;
  std::uint32_t p = 3;
  GODWIT_FIELDS(password_hash, "accounts.password_hash", salt, hash, n, r, p);
  friend bool operator==(const password_hash&, const password_hash&) = default;
};

// With a new salt, at the cost of LIKE.
[[nodiscard]] password_hash hash_password(std::string_view password, const password_hash& like = {});

// Takes the same time for any password.
[[nodiscard]] bool is_password(std::string_view password, const password_hash& kept);

// What a file may ask for: no more than 64 MiB and no less than nothing.
[[nodiscard]] bool is_sane(const password_hash& kept);

// Tokens: of sessions, of programs, of links that log in once. 258 bits of the system's randomness, so that nobody
// guesses one, and what is kept of it (its SHA-256) needs no salt.
//
// Errors: an assertion when the system has no randomness. Thread: any. Source: RFC 4648, 5 (base64url).
inline constexpr std::size_t token_size = 43; // characters: letters, digits, - and _

[[nodiscard]] io::http::secret_text new_token();

// 64 hexadecimal digits; of anything, also of what is no token.
[[nodiscard]] std::string hash_of_token(std::string_view token);

// N bytes of the system's randomness, as hexadecimal digits.
[[nodiscard]] std::string random_hex(std::size_t bytes);

} // namespace godwit::accounts
