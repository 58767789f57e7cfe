// Writes a .tlog of any length into files of bounded size: NAME.tlog is the one that is being written, NAME.1.tlog the
// one before it, and so on up to `older_files`; what is older is deleted. One that is there at the start is kept as if
// it had become full. With `next_file` its owner names the files instead, and bounds them.
//
// No secret gets in: signatures are taken off (strip_signature.hpp), and SETUP_SIGNING, which carries the key, is never
// written. Records are gathered in a buffer and handed to the kernel when it is full and at flush(), which the owner
// calls now and then: that is what a SIGKILL may cost.
//
// Errors: io, disk_full, invalid_argument. When the system refuses, what was in the buffer is lost and counted, the
// file is left without a torn record, and the next flush, or full buffer, tries again: a full disk that has room again
// needs no help. Times in microseconds since 1970 UTC, sizes in bytes. Blocks on the disk. Thread: one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "io/mcap/output_file.hpp"

namespace godwit::io::mavlink {

struct tlog_writer_options {
  std::filesystem::path file; // NAME.tlog, in a folder that exists
  std::uint64_t file_bytes = std::uint64_t{64} << 20;
  unsigned older_files = 3;
  // The name of one more file, which is not there yet. Empty: `file` and `older_files` say it.
  std::function<mcap::result<std::filesystem::path>()> next_file = {};
};

struct tlog_writer_counts {
  std::uint64_t frames_written = 0; // handed to the kernel
  std::uint64_t frames_lost = 0;    // accepted and then not written because of an error
  std::uint64_t keys_withheld = 0;  // SETUP_SIGNING
  std::uint64_t files_opened = 0;
  std::uint64_t failures = 0; // times that the system refused something
};

class tlog_writer {
public:
  static constexpr std::size_t buffer_bytes = std::size_t{64} << 10;
  static constexpr unsigned max_older_files = 99;

  tlog_writer() = default;
  ~tlog_writer() { static_cast<void>(close()); }
  tlog_writer(const tlog_writer&) = delete;
  tlog_writer& operator=(const tlog_writer&) = delete;

  // Checks the options. The file is made when there is something to write.
  [[nodiscard]] mcap::result<void> open(tlog_writer_options options);
  // The frame is copied. An error means that frames before it were lost; it waits in the buffer itself.
  [[nodiscard]] mcap::result<void> write(std::uint64_t timestamp_us, const frame_view& frame);
  [[nodiscard]] mcap::result<void> flush();
  [[nodiscard]] mcap::result<void> close();

  [[nodiscard]] const tlog_writer_counts& counts() const { return counts_; }

private:
  [[nodiscard]] mcap::result<void> provide_file();
  void give_up_file();
  [[nodiscard]] mcap::result<std::filesystem::path> next_name();
  [[nodiscard]] mcap::result<void> make_room_for_name();
  // NAME.N.tlog, for 0 NAME.tlog.
  [[nodiscard]] std::filesystem::path name_of(unsigned age) const;

  tlog_writer_options options_;
  mcap::output_file file_;
  std::vector<std::byte> buffer_; // whole records, at most buffer_bytes
  std::uint64_t frames_in_buffer_ = 0;
  tlog_writer_counts counts_;
};

} // namespace godwit::io::mavlink
