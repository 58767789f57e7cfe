// Writes a recording of any length into the segments of a folder: opens the next one when one is full, deletes the
// oldest when the folder is, and keeps the ids of schemas and channels through all of them.
//
//            first message                 full                       next message
//   idle ----------------> segment open ----------> closed, indexed --------------> segment open
//                             | the system refused something, or the segment is no longer in its place
//                             v
//                          failed --- tick() after retry_interval_ns: complete the broken segment ---> idle
//
// There is no clock inside: tick(now) flushes and retries. In `failed` messages are refused and counted; the count goes
// into the next segment as metadata "godwit.lost". Times in nanoseconds, `now_ns` of a steady clock; sizes in bytes.
// Errors: as segment_writer and segment_folder. Thread: one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "io/mcap/channel_registry.hpp"
#include "io/mcap/segment_folder.hpp"
#include "io/mcap/segment_writer.hpp"

namespace godwit::io::mcap {

struct rotating_writer_options {
  segment_folder_options segments;
  std::uint64_t run = 0;                           // part of the names: a counter of starts, or seconds since 1970
  string_map run_info;                             // metadata "godwit.run" at the start of every segment
  std::uint64_t flush_interval_ns = 100'000'000;   // what a SIGKILL may cost
  std::uint64_t retry_interval_ns = 1'000'000'000; // after a failure; a full disk is not asked more often
  std::uint64_t look_interval_ns = 1'000'000'000;  // whether the segment is still in its place
};

struct rotating_writer_counts {
  std::uint64_t messages_flushed = 0; // handed to the kernel, in all segments
  std::uint64_t messages_lost = 0;    // refused, or accepted and then not written because of an error
  std::uint64_t segments_opened = 0;
  std::uint64_t segments_deleted = 0; // for the bound of the folder
  std::uint64_t failures = 0;         // times that the state became `failed`
};

class rotating_writer {
public:
  rotating_writer() : writer_{channels_} {}
  ~rotating_writer() { static_cast<void>(close()); }
  rotating_writer(const rotating_writer&) = delete;
  rotating_writer& operator=(const rotating_writer&) = delete;

  // Checks the options and lists the folder; the first segment is opened by the first message. Segments of earlier runs
  // are not completed here: see folder().complete_all().
  [[nodiscard]] result<void> open(rotating_writer_options options);

  // See channel_registry.hpp; before or after open().
  [[nodiscard]] result<schema_id> add_schema(std::string_view name, std::string_view encoding, byte_view data);
  [[nodiscard]] result<channel_id> add_channel(schema_id schema, std::string_view topic,
                                               std::string_view message_encoding, const string_map& metadata = {});

  // The payload is copied. An error means that this message is lost (and counted).
  [[nodiscard]] result<void> write(const message_record& message);
  [[nodiscard]] result<void> add_metadata(std::string_view name, const string_map& values);
  // Flushes when flush_interval_ns have passed since the last time; leaves the failed state when it can.
  [[nodiscard]] result<void> tick(std::uint64_t now_ns);
  [[nodiscard]] result<void> flush();
  // Closes the open segment with its index; the next message opens another one. Also called by the destructor.
  [[nodiscard]] result<void> close();

  [[nodiscard]] bool has_failed() const { return failure_.has_value(); }
  [[nodiscard]] rotating_writer_counts counts() const;
  [[nodiscard]] segment_folder& folder() { return folder_; }
  // The segment that is being written, empty when there is none.
  [[nodiscard]] std::filesystem::path current_segment() const;

private:
  [[nodiscard]] result<void> start_segment();
  [[nodiscard]] result<void> add_opening_metadata();
  [[nodiscard]] result<void> recover();
  [[nodiscard]] result<void> look_at_place();
  // Opens a segment when none is open, or another one when what costs `closed_bytes` does not fit.
  template <class ClosedBytes>
  [[nodiscard]] result<void> provide_segment(ClosedBytes closed_bytes);
  // Passes a result on; a failure of the writer itself (not of one call) ends in the failed state.
  [[nodiscard]] result<void> checked(result<void> outcome);
  void fail(const error& why);

  rotating_writer_options options_;
  channel_registry channels_;
  segment_folder folder_;
  segment_writer writer_;
  bool has_segment_ = false; // the newest of the folder is the one that is being written
  std::optional<error> failure_;
  std::filesystem::path broken_; // a segment with messages in it and without its end
  std::uint64_t now_ns_ = 0;     // of the last tick
  std::uint64_t flushed_at_ns_ = 0;
  std::uint64_t retry_at_ns_ = 0;
  std::uint64_t looked_at_ns_ = 0;
  std::uint64_t lost_written_down_ = 0;
  rotating_writer_counts counts_; // of the segments before the open one
};

} // namespace godwit::io::mcap
