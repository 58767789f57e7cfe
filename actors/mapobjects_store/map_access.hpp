// How work gets to the map, whoever does it: the writer's thread, or a test in its own one.
//
// WORK(map_tables&) gives a map_result<T>; DONE(const map_result<T>&) hears it when it is durable, or why it never will
// be, once. WORK may run several times before one of them counts. Refused here (full, closed): DONE is not called.
// Thread: any; which one calls DONE is said by who implements it.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "actors/mapobjects_store/garbage.hpp"
#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/map_store.hpp"
#include "actors/mapobjects_store/pass_review.hpp"
#include "io/sqlite/group_target.hpp"

namespace godwit::mapobjects_store {

// What waits for the writer of the map: changes, which share a transaction, and long jobs, which are begun when all
// that came before them is durable.
//
// Thread: plain values; the writer runs them.

// A change of the map, tried again from its beginning when the disk refuses it.
struct queued_change {
  map_store::change work;
  std::function<void(const map_result<void>&)> done;
};

// Makes a long job; tells its asker itself when that fails.
struct queued_job {
  std::function<std::unique_ptr<staged_work>(map_store&)> start;
  std::function<void(const map_error&)> dropped; // instead of being started
};

using queued_work = std::variant<queued_change, queued_job>;

struct map_writer_status {
  bool failing = false;      // the last commit failed, the writer keeps trying
  std::string reason;        // sentence for people while failing
  std::uint64_t commits = 0; // transactions that reached the disk
  std::uint64_t changes = 0; // in them
  std::uint64_t retries = 0; // groups tried again after an error
  std::size_t queued = 0;    // waits now
  double fill = 0;           // of the bound on what waits: 0 = empty, 1 = refuses; see io::sqlite::nearly_full
};

class map_access {
public:
  map_access() = default;
  map_access(const map_access&) = delete;
  map_access& operator=(const map_access&) = delete;
  virtual ~map_access() = default;

  template <class Work, class Done>
  [[nodiscard]] map_result<void> post(Work work, Done done);

  // Of a load that was begun by posting `begin`.
  [[nodiscard]] map_result<void> add_page(load_page page, const page_stage::callback& done);
  [[nodiscard]] map_result<void> finish(const finish_load& asked, const load_finish::callback& done);

  // All sightings that were posted before it count.
  [[nodiscard]] map_result<void> review(pass_end pass, const pass_review::callback& done);

  [[nodiscard]] virtual map_result<void> push(queued_work item) = 0;
  [[nodiscard]] virtual map_writer_status status() const = 0;
};

template <class Work, class Done>
map_result<void> map_access::post(Work work, Done done) {
  using result = decltype(work(std::declval<map_tables&>()));
  auto slot = std::make_shared<std::optional<result>>();
  return push(queued_change{.work = [slot, work = std::move(work)](map_tables& t) -> map_result<void> {
                              *slot = work(t);
                              if (!**slot)
                                return tl::unexpected((*slot)->error());
                              return {};
                            },
                            .done =
                                [slot, done = std::move(done)](const map_result<void>& outcome) {
                                  done(outcome ? std::move(**slot) : result(tl::unexpected(outcome.error())));
                                }});
}

// What the map's writer does with what waits: changes commit in groups, long jobs (pages of a load, the end of a pass,
// garbage) go on in turns.
//
// Each change is decided inside the transaction that makes it durable. One that is refused before it has written
// anything leaves those beside it alone; one that goes wrong half way is left out, and they are tried again without it.
// Thread: the writer's.
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
