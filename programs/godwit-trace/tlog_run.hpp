// The command `tlog`: prints what a .tlog holds.
//
// Broken records are passed over and counted at the end, on stderr or in the tables. Times are those of the log.
// Errors: a sentence on stderr and exit_code::failed for a file that can not be read or holds no frame; a reader of the
// output that goes away ends it in order. Blocks on the disk. Thread: one.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "io/mavlink/tlog/tlog_writer.hpp"
#include "programs/common/command.hpp"
#include "programs/godwit-trace/message_printer.hpp"
#include "programs/godwit-trace/output.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

using programs::exit_code;

struct tlog_options {
  std::string file;
  print_options print;
  print_time time = print_time::utc;
  time_range range;
};

[[nodiscard]] exit_code run_tlog(const tlog_options& options, console& to);

// The file into which `link` records what it hears. Never takes the program down: what can not be written is said once
// and counted.
//
// Signatures are taken off and keys are left out, as in every log of godwit. Errors: sentences. Blocks on the disk.
// Thread: one at a time.
class tlog_recording {
public:
  static constexpr std::uint64_t file_bytes = std::uint64_t{1} << 30; // then a new one is begun
  static constexpr unsigned older_files = 9;                          // 10 GiB in all: days of a busy link

  // An older recording of the same name is kept as NAME.1.tlog.
  [[nodiscard]] tl::expected<void, std::string> open(const std::string& file);

  // The sentence to say, or none.
  [[nodiscard]] std::string write(std::uint64_t time_us, const io::mavlink::frame_view& frame);
  [[nodiscard]] std::string flush();
  // What became of it, at the end; none if nothing was opened.
  [[nodiscard]] std::string close();

  [[nodiscard]] bool has_lost() const { return writer_.counts().frames_lost != 0; }

private:
  [[nodiscard]] std::string once(const io::mcap::result<void>& result);

  std::string file_; // empty: nothing is recorded
  io::mavlink::tlog_writer writer_;
  bool told_ = false;
};

} // namespace godwit::trace_tool
