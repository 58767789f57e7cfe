// The map's file, open for writing: transactions with one change after the other in them.
//
// All work on the map is a function of map_tables: record, judge, take, begin and so on. Such a
// function looks before it writes: one that refuses its input has written nothing, and the changes beside it in the
// transaction stand. (A savepoint for each would cost more than the change itself.) Thread: one at a time.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "actors/mapobjects_store/map_file.hpp"
#include "actors/mapobjects_store/map_tables.hpp"
#include "actors/mapobjects_store/pass_review.hpp"
#include "actors/mapobjects_store/staged_work.hpp"
#include "io/sqlite/database.hpp"
#include "io/sqlite/log_keeper.hpp"

namespace godwit::mapobjects_store {

struct map_store_options {
  map_file_options file = {};
  settings rules = {};
};

// Whether a commit waits for the disk. One that does syncs all that was committed before it too.
enum class commit_is { synced, synced_later };

[[nodiscard]] commit_is commit_of(const staged_work& next_turn);

class map_store {
public:
  using change = std::function<map_result<void>(map_tables&)>;

  // Blocks on the disk. A load that was under way is given up.
  [[nodiscard]] static map_result<std::unique_ptr<map_store>> open(const map_store_options& options);
  ~map_store();
  map_store(const map_store&) = delete;
  map_store& operator=(const map_store&) = delete;

  [[nodiscard]] map_result<void> begin(commit_is how = commit_is::synced);
  // Within a transaction. After an error that left something written the transaction is spoilt: roll back.
  [[nodiscard]] map_result<void> apply(const change& work);
  [[nodiscard]] map_result<bool> apply(staged_work& work, decision_context& now);
  [[nodiscard]] bool is_spoilt() const { return spoilt_; }
  [[nodiscard]] map_result<void> commit();
  void roll_back();

  // The three in one, for whoever has a single change: the result of WORK(map_tables&).
  template <class Work>
  auto transact(const Work& work) -> decltype(work(std::declval<map_tables&>()));

  // All turns of a long job, one after the other.
  [[nodiscard]] map_result<void> run(staged_work& work);

  // A job for the end of a pass.
  [[nodiscard]] map_result<std::unique_ptr<pass_review>> review(const pass_end& pass, pass_review::callback done) const;

  // Between transactions; BUSY: others wait.
  void look_after_log(bool busy) { log_.look_after(busy); }

  [[nodiscard]] const map_row& map() const { return map_; }
  [[nodiscard]] const load_progress& load() const { return load_; }

private:
  map_store(const map_store_options& options, io::sqlite::store_file file);

  map_store_options options_;
  io::sqlite::store_file file_;
  io::sqlite::log_keeper log_;
  sql q_;
  map_row map_;       // as it will be when the transaction commits
  map_row committed_; // as it is in the file
  load_progress load_;
  map_tables tables_;
  std::optional<io::sqlite::transaction> open_;
  commit_is commits_ = commit_is::synced; // as the database is set now
  bool spoilt_ = false;
};

template <class Work>
auto map_store::transact(const Work& work) -> decltype(work(std::declval<map_tables&>())) {
  std::optional<decltype(work(tables_))> result;
  auto done = begin()
                  .and_then([&] {
                    return apply([&](map_tables& t) -> map_result<void> {
                      result = work(t);
                      if (!*result)
                        return tl::unexpected(result->error());
                      return {};
                    });
                  })
                  .and_then([&] { return commit(); });
  if (!done) {
    roll_back();
    return tl::unexpected(std::move(done.error()));
  }
  return std::move(*result);
}

} // namespace godwit::mapobjects_store
