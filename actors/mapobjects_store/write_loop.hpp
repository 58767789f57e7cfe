// What the writer's thread does; drawn in map_writer.hpp. Thread: run is the writer's thread; status from any.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "actors/mapobjects_store/garbage.hpp"
#include "actors/mapobjects_store/map_writer.hpp"

namespace godwit::mapobjects_store {

class write_loop {
public:
  write_loop(const map_writer_options& options, std::unique_ptr<map_store> store, work_queue& queue);

  // Returns when the queue is closed and all is written, or given up after the close timeout. The file is closed then.
  void run();

  [[nodiscard]] map_writer_status status() const;

private:
  using time_point = std::chrono::steady_clock::time_point;
  enum class group_outcome { committed, disk_error, one_is_wrong };

  std::optional<time_point> next_turn() const;
  bool must_stop(bool closing);
  void work();
  void give_up_rest();

  void start_jobs();
  void commit_group();
  std::size_t group_size() const;
  group_outcome try_group(std::size_t size);
  void finish_group(std::size_t size);

  void take_turn();
  void end_turn(const map_result<void>& result);
  void look_for_garbage();

  void disk_failed(const map_error& error);
  void disk_works(std::size_t changes);

  const map_writer_options options_;
  std::unique_ptr<map_store> store_;
  work_queue& queue_;

  std::deque<queued_work> backlog_;             // taken from the queue, not finished
  std::vector<map_result<void>> group_results_; // of the changes in the group
  std::vector<bool> left_out_;                  // of these: it went wrong half way
  std::deque<std::unique_ptr<staged_work>> jobs_;
  time_point last_turn_{};

  // Only when there is no other job. What the map was like when it began: another one has garbage again.
  std::unique_ptr<garbage_collection> garbage_;
  std::int64_t clean_generation_ = -1;
  std::int64_t clean_loading_ = 0;
  std::string clean_mission_;
  std::uint64_t changes_since_clean_ = 0;

  bool failing_ = false;
  time_point next_try_{};
  std::chrono::milliseconds retry_delay_;
  std::optional<time_point> close_deadline_;

  mutable std::mutex status_mutex_;
  map_writer_status status_;
};

} // namespace godwit::mapobjects_store
