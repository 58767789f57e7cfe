// The writer of the map (io/sqlite/group_writer.hpp): what waits commits as one group. Long jobs (pages of a load, the
// end of a pass, garbage) get a turn when nobody waits, and one in 100 ms when somebody always does.
//
// Each change is decided inside the transaction that makes it durable: it sees all that was decided before it, and its
// answer is given when it can not be lost any more. While the disk refuses, nobody's `done` is called; what comes
// waits, up to the bound of the queue. Thread: push and status from any; `done` is called on the writer's thread, once,
// and must be quick; close and the destructor not from there.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "actors/mapobjects_store/map_access.hpp"

namespace godwit::mapobjects_store {

struct map_writer_options {
  map_store_options store = {};

  // While the disk refuses to write everything waits here: at 30 sightings a second these are five minutes.
  std::size_t max_queued = 10'000;

  // One transaction: bounds the wait of the next group. 256 sightings take some 25 ms.
  std::size_t max_group = 256;

  // After a disk error: the first wait, doubled each time up to the last.
  std::chrono::milliseconds retry_min{10};
  std::chrono::milliseconds retry_max{2'000};

  // How long close tries to write what waits.
  std::chrono::milliseconds close_timeout{5'000};

  // On the writer's thread, when `failing` turns on or off.
  std::function<void(const map_writer_status&)> on_health_change = {};

  // False: nothing happens but in run_once and close. Tests and whole systems in virtual time.
  bool own_thread = true;
  std::function<std::chrono::steady_clock::time_point()> clock = &std::chrono::steady_clock::now;
};

class map_writer final : public map_access {
public:
  // Blocks on the disk.
  [[nodiscard]] static map_result<std::unique_ptr<map_writer>> open(const map_writer_options& options);
  ~map_writer() override;

  [[nodiscard]] map_result<void> push(queued_work item) override;
  [[nodiscard]] map_writer_status status() const override;

  // Without a thread of its own: does what can be done now, at most one transaction.
  void run_once();

  // Writes what waits within the close timeout, and tells the rest and the unfinished jobs that it is closed. Once.
  void close();

private:
  struct parts;

  explicit map_writer(std::unique_ptr<parts> made);

  std::unique_ptr<parts> parts_;
};

} // namespace godwit::mapobjects_store
