// The flight recorder of the actors: every delivery, into MCAP files, without making the actors wait.
//
//   actor threads ──encode──> one byte_ring each ──> writer thread ──render JSON──> segments godwit-RUN-N.mcap
//
// record() copies header and encoded message into the ring of its thread. The writer thread renders and writes; what
// was recorded is in the file, and so safe from SIGKILL, after at most the flush interval and the time to render. A
// ring that is full drops the record and counts it; the counts are written into the trace as messages of type
// runtime.trace_loss. Each actor and message type has a channel /ACTOR/TYPE with a JSON Schema. log_time is wall time
// (ns). Thread: record() from any thread; everything else from the owner.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "runtime/clock.hpp"
#include "runtime/directory.hpp"
#include "runtime/health_board.hpp"
#include "runtime/trace/tick_clock.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

struct trace_options {
  std::filesystem::path folder;
  std::uint64_t segment_bytes = std::uint64_t{8} << 20U;
  std::uint64_t total_bytes = std::uint64_t{256} << 20U; // of all segments; the oldest are deleted
  milliseconds flush{100};
  std::uint64_t run = 1; // part of the file names; the journal counts it
  std::string program = "godwit";
  // What else a reader has to know of the run, such as its settings without secrets; in each segment.
  std::map<std::string, std::string> about;
};

struct trace_counts {
  std::uint64_t recorded = 0;  // taken into a ring
  std::uint64_t dropped = 0;   // a ring was full
  std::uint64_t oversize = 0;  // recorded without its message, which was longer than max_payload
  std::uint64_t written = 0;   // in the files
  std::uint64_t unwritten = 0; // lost because the disk refused
};

class ring_trace final : public trace_sink {
public:
  static constexpr std::size_t ring_bytes = std::size_t{1}
                                            << 20U;     // some 8,000 records; a worker fills it in 8 ms at the most
  static constexpr std::size_t max_payload = 64 * 1024; // encoded bytes of one message
  static constexpr std::size_t max_threads = 64;        // rings; records of further threads are dropped and counted

  // Completes the segments of earlier runs, then starts the writer. The error is a sentence that names the folder and
  // what to do. NAMES, TIME and HEALTH must live longer.
  [[nodiscard]] static tl::expected<std::unique_ptr<ring_trace>, std::string>
  open(trace_options options, const directory& names, const time_source& time, health_board& health);

  ~ring_trace() override;

  [[nodiscard]] std::int64_t ticks() const noexcept override { return tick_clock::now(); }
  void record(const trace_entry& entry, const message_type& type, const void* body) noexcept override;

  // Writes all that was recorded so far and ends the last segment.
  void close();
  [[nodiscard]] trace_counts counts() const;

private:
  class writer;
  struct shared;

  explicit ring_trace(std::unique_ptr<shared> state);

  std::unique_ptr<shared> shared_;
  std::unique_ptr<writer> writer_;
};

} // namespace godwit::runtime
