// The files that hold a token or a private key.
//
// Such a file must be a regular file of mode 0600 exactly that belongs to the user under whom the program runs, and not
// a symbolic link: what others could have read or put there protects nothing. All this is checked on the open file, so
// that it can not be exchanged between check and reading.
//
// Errors: as values, with the code that the caller wants and a sentence that says the remedy and never shows the
// content. Blocks on the disk. Thread: any. Source: POSIX open(2), fstat(2); RFC 6750, 2.1 (form of a bearer token).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/http/error.hpp"
#include "io/http/secret_text.hpp"

namespace godwit::io::http {

inline constexpr std::size_t max_token_bytes = 8 * 1024; // what servers take as one header
inline constexpr std::size_t max_key_bytes = 64 * 1024;  // a key of RSA 16384 in PEM has 13 kB

[[nodiscard]] result<secret_text> load_secret_file(const std::string& file, std::size_t max_bytes, errc code);

// Written whole beside it and renamed over it, with that mode; on the disk when this returns.
[[nodiscard]] result<void> store_secret_file(const std::string& file, std::string_view content, errc code);

// One end of line after the token is cut off. What is left must be a token, and not, say, two lines.
[[nodiscard]] result<secret_text> load_token(const std::string& file);

} // namespace godwit::io::http
