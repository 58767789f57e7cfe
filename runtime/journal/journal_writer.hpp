// The thread that writes the journal: takes what waits, commits it as one group, tells everyone, and starts again.
//
//            +--------- nothing waits ---------+
//            v                                 |
//   [idle] --work--> [group] --committed--> done callbacks --> checkpoint, one chunk of a load
//                      |  ^
//          disk error  |  | after 10, 20, ... 2000 ms; at once when closing
//                      v  |
//                    [failing]   nobody's `done` is called; recoveries are answered from the database plus the waiting
//                    writes
//
// A write whose statement is wrong (a mistake of its program) would hold up all the others: the group is tried again
// without it, and it and the later writes of its actor fail until that actor recovers, because they build on what never
// became durable. Thread: run is the writer thread; status may be asked from any.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "runtime/journal/load_stage.hpp"
#include "runtime/journal/write_queue.hpp"

namespace godwit::runtime {

struct writer_options {
  std::string path;
  std::size_t max_group_writes = 0;
  std::size_t max_group_bytes = 0;
  std::size_t checkpoint_bytes = 0;
  std::chrono::milliseconds retry_min{};
  std::chrono::milliseconds retry_max{};
  std::chrono::milliseconds close_timeout{};
  chunk_limits chunk;
  std::function<void(const journal_status&)> on_health_change;
};

class journal_writer {
public:
  journal_writer(writer_options options, io::sqlite::database db, std::uint64_t run_number, write_queue& queue);

  // Returns when the queue is closed and everything is written, or given up after the close timeout.
  void run();

  [[nodiscard]] journal_status status() const;

private:
  using time_point = std::chrono::steady_clock::time_point;
  enum class group_outcome { committed, disk_error, one_is_wrong };

  std::optional<time_point> next_turn() const;
  bool must_stop(bool closing);
  void work();
  void give_up_rest();

  void commit_group();
  std::size_t group_size() const;
  group_outcome try_group(std::size_t size);
  group_outcome group_failed(const io::sqlite::error& error, std::size_t size);
  void finish_group(std::size_t size);
  void fail_write(std::size_t index, const journal_error& error);
  void mark_arrivals();

  void answer(queued_recovery& recovery, std::size_t writes_before);
  void answer_while_failing();

  void stage_load();
  void finish_load(const commit_result& result);

  void disk_failed(const io::sqlite::error& error, const std::string& doing);
  void disk_works();
  void checkpoint_when_long();
  static int count_frames(void* self, sqlite3* connection, const char* schema, int frames);

  const writer_options options_;
  io::sqlite::database db_;
  record_store store_;
  write_queue& queue_;

  std::deque<queue_item> backlog_; // taken from the queue, not finished
  std::size_t marked_ = 0;         // items of the backlog that mark_arrivals has looked at
  std::deque<load_stage> loads_;
  std::unordered_map<std::string, journal_error> broken_; // actors with a failed write, until they recover

  time_point next_try_{};
  std::chrono::milliseconds retry_delay_{};
  std::optional<time_point> close_deadline_;
  time_point last_chunk_{};
  int log_frames_ = 0; // of the write-ahead log after the last commit
  int checkpoint_at_frames_ = 0;
  int checkpoint_step_frames_ = 0;

  mutable std::mutex status_mutex_;
  journal_status status_;
};

} // namespace godwit::runtime
