// What the map's writer does with what waits: changes commit in groups, long jobs (pages of a load, the end of a pass,
// garbage) go on in turns.
//
// Each change is decided inside the transaction that makes it durable. One that is refused before it has written
// anything leaves those beside it alone; one that goes wrong half way is left out, and they are tried again without it.
// Thread: the writer's.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "actors/mapobjects_store/garbage.hpp"
#include "actors/mapobjects_store/map_work.hpp"
#include "io/sqlite/group_target.hpp"

namespace godwit::mapobjects_store {

struct map_item {
  queued_work work;
  map_result<void> said = {}; // by the change itself, in the try that counts
};

class map_target final : public io::sqlite::group_target<map_item> {
public:
  using time_point = std::chrono::steady_clock::time_point;

  map_target(std::unique_ptr<map_store> store, std::function<time_point()> clock)
      : store_(std::move(store)), clock_(std::move(clock)) {}

  [[nodiscard]] bool is_write(const map_item& item) const override;
  [[nodiscard]] io::sqlite::store_result<void> begin() override;
  [[nodiscard]] io::sqlite::store_result<void> apply(map_item& item) override;
  [[nodiscard]] io::sqlite::store_result<void> commit() override;
  void roll_back() override { store_->roll_back(); }
  void finish(map_item& item, const io::sqlite::store_result<void>& result) override;
  void run(map_item& job) override;
  void give_up(map_item& item, const std::optional<io::sqlite::store_error>& why) override;
  [[nodiscard]] bool has_turn() override;
  [[nodiscard]] io::sqlite::store_result<bool> take_turn(const std::function<bool()>& urgent) override;
  void look_after_log(bool busy) override { store_->look_after_log(busy); }
  void close() override;

private:
  void look_for_garbage();
  void end_job(const map_result<void>& result);

  std::unique_ptr<map_store> store_;
  const std::function<time_point()> clock_;
  std::deque<std::unique_ptr<staged_work>> jobs_;

  // Only when there is no other job. What the map was like when it began: another one has garbage again.
  std::unique_ptr<garbage_collection> garbage_;
  std::int64_t clean_generation_ = -1;
  std::int64_t clean_loading_ = 0;
  std::string clean_mission_;
  std::uint64_t changes_since_clean_ = 0;
};

} // namespace godwit::mapobjects_store
