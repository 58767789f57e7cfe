// A file that is only appended to, with its errors as values.
//
// append() hands everything to the kernel before it returns: what it accepted outlives a SIGKILL of the process (not a
// loss of power: nothing is synced here, a trace is not worth the wait). Thread: one at a time. Source: POSIX write(2).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/mcap/error.hpp"
#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

class output_file {
public:
  output_file() = default;
  ~output_file() { static_cast<void>(close()); }
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;

  // The file must not exist yet; a device (as /dev/full) may.
  [[nodiscard]] result<void> create(const std::filesystem::path& path);
  // Opens an existing file and drops everything after `keep_bytes`.
  [[nodiscard]] result<void> open_and_cut(const std::filesystem::path& path, std::uint64_t keep_bytes);
  // On an error the file is cut back to what it was before, as far as the system lets us.
  [[nodiscard]] result<void> append(byte_view bytes);
  // Closing twice is harmless.
  [[nodiscard]] result<void> close();

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  // What is open is still what has its name: it was neither removed nor replaced.
  [[nodiscard]] bool is_in_place() const;
  [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }
  [[nodiscard]] const std::string& name() const { return name_; }

private:
  [[nodiscard]] result<void> open(const std::filesystem::path& path, int flags);
  [[nodiscard]] result<void> cut(std::uint64_t keep_bytes);

  int descriptor_ = -1;
  std::uint64_t size_bytes_ = 0;
  std::string name_;
};

} // namespace godwit::io::mcap
