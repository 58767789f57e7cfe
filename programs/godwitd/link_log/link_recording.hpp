// The .tlog files of one link: LINK-RUN-NUMBER.tlog beside the segments of the trace, bounded together.
//
// It finds the frames in what went over the link; bytes that are no right frame of a known id are not recorded, and no
// secret is: tlog_writer.hpp. Frames are recorded whether godwit believed them or not. Errors: those of the disk are
// kept for problem() and do not end anything: what could not be written is lost and counted, and a second later the
// next try is made. Blocks on the disk. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/link/status.hpp"
#include "io/mavlink/scanner.hpp"
#include "io/mavlink/tlog/tlog_writer.hpp"
#include "io/mcap/segment_folder.hpp"
#include "programs/godwitd/link_log/link_log_options.hpp"

namespace godwit::daemon {

// What goes over a link, on its way to the thread that writes it down.
//
// Bounded: what does not fit is dropped as a whole and counted, so that a disk that stands still holds no link up. Its
// memory is taken at the beginning, so that put() never waits for any. Thread: put from any, take by one.
struct link_chunk {
  std::uint64_t time_us = 0; // since 1970, UTC
  io::link::peer_id peer = 0;
  bool is_sent = false; // by us
  bool is_datagram = false;
  std::size_t size_bytes = 0;
};

// The bytes of all chunks stand one after the other.
struct link_batch {
  std::vector<link_chunk> chunks;
  std::vector<std::byte> bytes;
};

class chunk_buffer {
public:
  static constexpr std::size_t max_waiting_bytes = std::size_t{1} << 20U; // 40 s of a PX4 at its fastest streams
  static constexpr std::size_t max_waiting_chunks = 16'384;

  chunk_buffer() { reserve(waiting_); }

  // False: dropped.
  bool put(link_chunk chunk, std::span<const std::byte> bytes) {
    chunk.size_bytes = bytes.size();
    const std::lock_guard guard(mutex_);
    if (waiting_.chunks.size() == max_waiting_chunks || waiting_.bytes.size() + bytes.size() > max_waiting_bytes) {
      ++dropped_;
      return false;
    }
    waiting_.chunks.push_back(chunk);
    waiting_.bytes.insert(waiting_.bytes.end(), bytes.begin(), bytes.end());
    return true;
  }

  // All that waits, in its order, in place of what TO held. The memory of TO is used for what comes next.
  void take(link_batch& to) {
    to.chunks.clear();
    to.bytes.clear();
    reserve(to);
    const std::lock_guard guard(mutex_);
    std::swap(waiting_, to);
  }

  [[nodiscard]] std::uint64_t dropped() const { // chunks
    const std::lock_guard guard(mutex_);
    return dropped_;
  }

private:
  static void reserve(link_batch& to) {
    to.chunks.reserve(max_waiting_chunks);
    to.bytes.reserve(max_waiting_bytes);
  }

  mutable std::mutex mutex_;
  link_batch waiting_;
  std::uint64_t dropped_ = 0;
};

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
