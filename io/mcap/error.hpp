// What can go wrong with an MCAP file, as a value for the caller and a sentence for people.
//
// Thread: plain value, any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::io::mcap {

enum class errc {
  io,               // the system refused or failed an operation on the file or folder
  disk_full,        // no space left (ENOSPC, EDQUOT)
  too_large,        // a payload, record or set of definitions is above its bound
  too_many,         // no identifier left for a schema, channel or segment
  malformed,        // the bytes are not MCAP
  crc_mismatch,     // the bytes were MCAP once
  unsupported,      // valid MCAP that this reader does not handle (compression, attachments in a repair)
  invalid_argument, // the caller asked for something impossible; nothing was changed
  gone,             // the file was removed or replaced while it was written
  not_open,         // the writer is closed or has failed before
};

struct error {
  errc code{};
  std::string file;               // the path concerned, empty when the data is only in memory
  std::string what;               // what is wrong, with the system's own words where it gave some
  std::uint64_t offset_bytes = 0; // where in the file, for errors found by reading

  // "/var/lib/godwit/trace/godwit-0000000001-000001.mcap: disk full: write: No space left on device"
  [[nodiscard]] std::string message() const;
  bool operator==(const error&) const = default;
};

template <class T>
using result = tl::expected<T, error>;

[[nodiscard]] const char* to_string(errc code);

// An error for a failed system call: `operation` in a word or two, `number` the errno it left.
[[nodiscard]] error system_error(std::string file, std::string_view operation, int number);

} // namespace godwit::io::mcap
