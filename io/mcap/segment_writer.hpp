// Writes one MCAP file that a streaming reader can follow while it grows and that is indexed once it is closed.
//
//   open -> write*, add_metadata*, flush* -> close
//     \________ a failed system call ________\-> failed: nothing more is accepted, complete() (repair.hpp) mends the
//     file
//
// Messages gather in a chunk. flush() hands chunk, message index and metadata to the kernel in one write(2): what was
// flushed outlives a SIGKILL. A schema and a channel are written into the chunk before their first message, under the
// ids of the registry, and again into the summary. Times in nanoseconds, sizes in bytes.
// Errors: disk_full and io (the writer is failed then, the messages of the open chunk are lost and counted);
// too_large and invalid_argument refuse one call and change nothing; not_open. Thread: one at a time.
// Source: MCAP specification, https://mcap.dev/spec
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "io/mcap/channel_registry.hpp"
#include "io/mcap/chunks.hpp"
#include "io/mcap/error.hpp"
#include "io/mcap/output_file.hpp"
#include "io/mcap/summary.hpp"

namespace godwit::io::mcap {

class segment_writer {
public:
  // A chunk that has grown to this is flushed without being asked, so that memory stays bounded.
  static constexpr std::size_t chunk_flush_bytes = std::size_t{1} << 20;

  // The registry must outlive the writer; channels may be added to it at any time.
  explicit segment_writer(const channel_registry& channels) : channels_{channels} {}

  [[nodiscard]] result<void> open(const std::filesystem::path& path);
  [[nodiscard]] result<void> write(const message_record& message);
  // Key-value information about the recording (run, drop counts); reaches the file with the next flush.
  [[nodiscard]] result<void> add_metadata(std::string_view name, const string_map& values);
  [[nodiscard]] result<void> flush();
  // Flushes, then writes Data End, summary and footer. The writer can be opened again for another file.
  [[nodiscard]] result<void> close();
  // Gives the file up as it is, without its end.
  void abandon();

  [[nodiscard]] bool is_open() const { return file_.is_open() && !failure_; }
  [[nodiscard]] bool is_in_place() const { return file_.is_in_place(); } // of what is open
  [[nodiscard]] std::uint64_t bytes_written() const { return file_.size_bytes(); }
  [[nodiscard]] std::uint64_t messages_flushed() const { return messages_flushed_; }
  // Messages that were accepted by write() but could not be flushed, since open().
  [[nodiscard]] std::uint64_t messages_lost() const { return messages_lost_; }
  // An upper bound for the size of the closed file, if this message were written into it first.
  [[nodiscard]] std::uint64_t closed_bytes_with(channel_id channel, std::size_t payload_bytes) const;
  // The same for metadata.
  [[nodiscard]] std::uint64_t closed_bytes_with(std::string_view name, const string_map& values) const;

private:
  struct pending_metadata {
    std::size_t at;
    std::size_t bytes;
    std::string name;
  };

  [[nodiscard]] result<void> check_open() const;
  [[nodiscard]] result<void> put(byte_view bytes);
  [[nodiscard]] bool is_defined(channel_id channel) const;
  [[nodiscard]] std::uint64_t closed_bytes() const;
  void define(channel_id channel);
  void forget();

  const channel_registry& channels_;
  output_file file_;
  std::optional<error> failure_;
  std::uint32_t data_crc_ = 0;
  chunk_builder chunk_;
  summary summary_;
  byte_buffer metadata_; // records that wait for the next flush: a chunk can not hold them
  std::vector<pending_metadata> metadata_places_;
  std::uint64_t metadata_index_bytes_ = 0;
  std::vector<bool> schema_defined_; // in this file, by id
  std::vector<bool> channel_defined_;
  std::uint64_t messages_flushed_ = 0;
  std::uint64_t messages_lost_ = 0;
};

} // namespace godwit::io::mcap
