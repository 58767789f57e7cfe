// Bodies that come compressed: gzip and zstd, piece by piece, so that what is unpacked is bounded by who takes it.
//
// A few bytes can stand for gigabytes: nothing is unpacked ahead of what the taker has room for, and the window of zstd
// is at most that of RFC 9659. One stream is a body; bytes after it are an error, and so is an end in the middle.
//
// Errors: malformed. Thread: one at a time. Source: RFC 9110, 8.4; RFC 1952; RFC 8878; RFC 9659.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/http/error.hpp"

namespace godwit::io::http {

enum class content_coding { gzip, zstd };

inline constexpr std::string_view accepted_codings = "zstd, gzip";
inline constexpr int max_zstd_window_log = 23; // 8 MiB

// VALUE of Content-Encoding; none: another one, or several.
[[nodiscard]] std::optional<content_coding> parse_coding(std::string_view value);

class content_decoder {
public:
  struct stream; // of one coding
  explicit content_decoder(content_coding how);
  ~content_decoder();
  content_decoder(const content_decoder&) = delete;
  content_decoder& operator=(const content_decoder&) = delete;

  // TAKE gets pieces of at most read_piece_bytes; false: it wants no more, and feed returns.
  [[nodiscard]] result<void> feed(std::span<const std::byte> bytes,
                                  const std::function<bool(std::span<const std::byte>)>& take);
  // The stream has ended, or none has begun.
  [[nodiscard]] bool is_complete() const;

private:
  std::unique_ptr<stream> stream_;
};

// For who answers: the coding to use for a request with this Accept-Encoding; none: it wants plain bytes.
[[nodiscard]] std::optional<content_coding> chosen_coding(std::string_view accept_encoding);
[[nodiscard]] std::string_view coding_name(content_coding how);
[[nodiscard]] std::string compressed(std::string_view body, content_coding how);

} // namespace godwit::io::http
