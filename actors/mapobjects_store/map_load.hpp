// A load replaces the map: pages are put beside what is shown, and the last step (load_finish) changes one row.
// Until then everybody sees the old map, whole. One load at a time; a new one gives up the older one, whose rows are
// then garbage.
//
// What this vehicle saw and has not delivered stays on the map across a load; so does what was delivered after the load
// began, because its pages may not have it yet. A load of changes takes over the rest of the copy from before at its
// end. Thread: the one of the database.
#pragma once

#include <functional>
#include <string>

#include "actors/mapobjects_store/staged_work.hpp"
#include "messages/mapobjects_store/load.hpp"

namespace godwit::mapobjects_store {

// Rows in one page; more is refused. Bounds the memory of a load beside that of its places.
inline constexpr std::size_t max_page_rows = 5000;

struct begun_load {
  std::int64_t number = 0;
  std::string mark; // of the copy from before
};
[[nodiscard]] map_result<begun_load> begin(map_tables& t, const begin_load& asked);

// A load that was given up, or never was, has no pages and no end.
[[nodiscard]] map_result<void> check_under_way(const map_tables& t, std::int64_t load);

// Puts a page beside the map, in turns. One that was put before is passed over, one that is not the next is refused. A
// page that fails ends the load: the caller begins anew.
class page_stage final : public staged_work {
public:
  using callback = std::function<void(const map_result<void>&)>;

  page_stage(load_page page, callback done) : page_(std::move(page)), done_(std::move(done)) {}

  [[nodiscard]] map_result<bool> stage(map_tables& t, decision_context& now) override;
  void committed() override { next_row_ = staged_row_; }
  [[nodiscard]] bool must_be_synced() const override { return false; } // a load does not outlive the process
  void finish(const map_result<void>& result) override;

private:
  [[nodiscard]] map_result<void> check(map_tables& t) const;
  void go_back(load_progress& load);
  [[nodiscard]] map_result<void> put(map_tables& t, std::size_t row);

  load_page page_;
  callback done_;
  load_progress* load_ = nullptr;  // once begun
  std::size_t objects_before_ = 0; // in the load, without this page
  std::int64_t ignored_before_ = 0;
  std::size_t removed_before_ = 0;
  std::size_t next_row_ = 0; // objects first, then ignored items; of those committed
  std::size_t staged_row_ = 0;
};

// The end of a load, in turns: of changes, the rest of the copy from before is taken over; its places are put into the
// tree that is not shown, and the last turn makes it the map.
//
// The tree is filled only now because then all places are known: put in along a curve, neighbours after each other,
// each node is touched while it is filled and not again. Thread: the writer's.
class load_finish final : public staged_work {
public:
  using callback = std::function<void(const map_result<void>&)>;

  load_finish(const finish_load& asked, callback done) : asked_(asked), done_(std::move(done)) {}

  // An object that comes twice ends the load; a wrong number of rows is refused.
  [[nodiscard]] map_result<bool> stage(map_tables& t, decision_context& now) override;
  void committed() override;
  [[nodiscard]] bool must_be_synced() const override; // only the last turn
  void finish(const map_result<void>& result) override;

private:
  [[nodiscard]] map_result<void> check(map_tables& t);
  // True: all of it.
  [[nodiscard]] map_result<bool> take_over(map_tables& t, decision_context& now);
  static void sort_along_curve(load_progress& load);
  [[nodiscard]] map_result<void> become_the_map(map_tables& t) const;

  finish_load asked_;
  callback done_;
  load_progress* load_ = nullptr;       // once all was there
  std::vector<ids::uuid_bits> changed_; // in order: what is not taken over
  std::size_t objects_ = 0;             // with those taken over; of those committed
  std::int64_t last_ = 0;               // row of the copy from before that was looked at; of those committed
  std::int64_t staged_last_ = 0;
  bool is_taken_over_ = false; // all of it, and committed
  bool takes_last_ = false;    // the turn before has
  bool begun_ = false;         // a turn was committed: the tree has what is counted by next_
  std::size_t next_ = 0;       // of the load's places: those before are in the tree
  std::size_t staged_ = 0;
};

} // namespace godwit::mapobjects_store
