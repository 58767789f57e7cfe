// The file that holds the secret key of a link.
//
// Its content is 64 hexadecimal digits, of either case, with or without an end of line after them; or the 32 bytes
// themselves. `openssl rand -hex 32 > FILE` makes one. It must be a regular file of mode 0600 exactly that belongs to
// the user under whom godwit runs, and not a symbolic link: a key that others could have read or put there protects
// nothing. All this is checked on the open file, so that it can not be exchanged between check and reading.
//
// Errors: as values, with a sentence that says the remedy and never shows the content. Blocks on the disk.
// Thread: any. Source: POSIX open(2), fstat(2).
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "io/mavlink/signing/secret_key.hpp"

namespace godwit::io::mavlink {

enum class key_file_errc {
  missing,
  not_readable,
  symbolic_link,
  not_a_file,
  other_owner,
  wrong_mode,
  not_a_key,
  all_zero
};

GODWIT_ENUM_NAMES(key_file_errc, missing, not_readable, symbolic_link, not_a_file, other_owner, wrong_mode, not_a_key,
                  all_zero);

struct key_file_error {
  key_file_errc code{};
  std::string file;
  std::string what; // what is wrong and what to do about it

  // "signing key /etc/godwit/signing.key: its mode is 0644 and must be 0600: chmod 600 /etc/godwit/signing.key"
  [[nodiscard]] std::string message() const { return "signing key " + file + ": " + what; }
};

[[nodiscard]] tl::expected<secret_key, key_file_error> load_key_file(const std::filesystem::path& path);

} // namespace godwit::io::mavlink
