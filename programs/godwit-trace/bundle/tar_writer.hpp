// Writes a tar archive of files for their owner alone.
//
// Members are plain files of mode 0600 of nobody in particular. Errors: those of the file; a name that is too long is
// an invalid_argument. Blocks on the disk. Thread: one at a time. Source: POSIX.1-2001, pax: ustar Interchange Format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/mcap/output_file.hpp"

namespace godwit::trace_tool {

class tar_writer {
public:
  static constexpr std::size_t max_name = 99;
  static constexpr std::uint64_t max_member_bytes = (std::uint64_t{1} << 33U) - 1; // eleven octal digits

  // The file must not exist yet. TIME_S: of all members, since 1970.
  [[nodiscard]] io::mcap::result<void> create(const std::filesystem::path& file, std::int64_t time_s);
  [[nodiscard]] io::mcap::result<void> add(const std::string& name, std::string_view text);
  // SIZE_BYTES of FILE; zeros where it has become shorter.
  [[nodiscard]] io::mcap::result<void> add_file(const std::string& name, const std::filesystem::path& file,
                                                std::uint64_t size_bytes);
  [[nodiscard]] io::mcap::result<void> close();

  [[nodiscard]] std::uint64_t size_bytes() const { return file_.size_bytes(); }

private:
  [[nodiscard]] io::mcap::result<void> add_header(const std::string& name, std::uint64_t size_bytes);
  [[nodiscard]] io::mcap::result<void> fill_block();

  io::mcap::output_file file_;
  std::int64_t time_s_ = 0;
};

} // namespace godwit::trace_tool
