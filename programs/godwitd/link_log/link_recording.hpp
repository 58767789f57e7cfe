// The .tlog files of one link: LINK-RUN-NUMBER.tlog beside the segments of the trace, bounded together.
//
// It finds the frames in what went over the link; bytes that are no right frame of a known id are not recorded, and no
// secret is: tlog_writer.hpp. Frames are recorded whether godwit believed them or not. Errors: those of the disk are
// kept for problem() and do not end anything: what could not be written is lost and counted, and a second later the
// next try is made. Blocks on the disk. Thread: one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "io/mavlink/scanner.hpp"
#include "io/mavlink/tlog/tlog_writer.hpp"
#include "io/mcap/segment_folder.hpp"
#include "programs/godwitd/link_log/chunk_buffer.hpp"
#include "programs/godwitd/link_log/link_log_options.hpp"

namespace godwit::daemon {

class link_recording {
public:
  static constexpr std::size_t max_streams = 32; // connections that are scanned at a time; a link has 16 peers
  static constexpr std::int64_t retry_interval_ns = 1'000'000'000;

  // LINK: "vehicle", "ground". Makes the folder; a file is made when there is something to write.
  [[nodiscard]] io::mcap::result<void> open(const link_log_options& options, const std::string& link,
                                            std::uint64_t run);

  void take(const link_batch& batch);
  // Hands what was taken to the kernel. NOW_NS: monotonic.
  void flush(std::int64_t now_ns);
  void close();

  // Why nothing is written at present; empty: it is.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const io::mavlink::tlog_writer_counts& counts() const { return writer_.counts(); }

private:
  [[nodiscard]] io::mcap::result<std::filesystem::path> next_file();
  void note(const io::mcap::result<void>& written);

  io::mcap::segment_folder folder_;
  std::uint64_t run_ = 0;
  bool has_file_ = false; // the newest of the folder is of this run
  io::mavlink::tlog_writer writer_;
  std::map<io::link::peer_id, io::mavlink::scanner> streams_; // datagrams of one peer may go on with each other, too
  io::mavlink::scanner sent_;
  std::string problem_;
  std::int64_t retry_at_ns_ = 0;
};

} // namespace godwit::daemon
