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

} // namespace godwit::accounts
