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
#include <utility>

#include <openssl/crypto.h>

#include "io/http/error.hpp"

namespace godwit::io::http {

// A token or a key in memory: wiped when it is no longer needed, never copied, and without a way into a log.
//
// Thread: as any value.
class secret_text {
public:
  secret_text() = default;
  explicit secret_text(std::size_t size) : text_(size, '\0') {}
  ~secret_text() { wipe(); }
  secret_text(const secret_text&) = delete;
  secret_text& operator=(const secret_text&) = delete;
  secret_text(secret_text&& other) noexcept : text_(std::move(other.text_)) { other.wipe(); }
  secret_text& operator=(secret_text&& other) noexcept {
    if (this != &other) {
      wipe();
      text_ = std::move(other.text_);
      other.wipe();
    }
    return *this;
  }

  [[nodiscard]] std::string_view revealed() const { return text_; }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] char* data() { return text_.data(); }
  // Only shorter: growing would leave a copy behind.
  void cut_to(std::size_t size) { text_.erase(size); }

private:
  // A short text lies within the object, and moving leaves it behind: so the whole room is wiped.
  void wipe() {
    text_.resize(text_.capacity());
    OPENSSL_cleanse(text_.data(), text_.size());
    text_.clear();
  }

  std::string text_;
};

inline constexpr std::size_t max_token_bytes = 8 * 1024; // what servers take as one header
inline constexpr std::size_t max_key_bytes = 64 * 1024;  // a key of RSA 16384 in PEM has 13 kB

[[nodiscard]] result<secret_text> load_secret_file(const std::string& file, std::size_t max_bytes, errc code);

// Written whole beside it and renamed over it, with that mode; on the disk when this returns.
[[nodiscard]] result<void> store_secret_file(const std::string& file, std::string_view content, errc code);

// One end of line after the token is cut off. What is left must be a token, and not, say, two lines.
[[nodiscard]] result<secret_text> load_token(const std::string& file);

} // namespace godwit::io::http
