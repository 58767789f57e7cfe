#include "actors/mapobjects_store/map_store.hpp"

#include <sqlite3.h>

#include "actors/mapobjects_store/input_check.hpp"
#include "runtime/assert.hpp"

namespace godwit::mapobjects_store {

namespace {

// Long: a load writes the same inner pages again and again, and they are moved once. Very long: a minute of sightings
// at full rate.
constexpr io::sqlite::log_bounds log_bounds{.long_bytes = 16 * 1024 * 1024, .very_long_bytes = 64 * 1024 * 1024};

} // namespace

commit_is commit_of(const staged_work& next_turn) {
  return next_turn.must_be_synced() ? commit_is::synced : commit_is::synced_later;
}

map_store::map_store(const map_store_options& options, io::sqlite::store_file file)
    : options_(options), file_(std::move(file)), log_(file_.db, log_bounds),
      q_(file_.db), tables_{q_, map_, load_, options_.rules} {}

map_result<std::unique_ptr<map_store>> map_store::open(const map_store_options& options) {
  auto file = open_map_for_writing(options.file);
  if (!file)
    return tl::unexpected(std::move(file.error()));
  std::unique_ptr<map_store> made(new map_store(options, std::move(*file)));
  auto map = load_map_row(made->q_);
  if (!map)
    return tl::unexpected(std::move(map.error()));
  made->map_ = *map;
  made->committed_ = std::move(*map);
  return made;
}

map_store::~map_store() {
  roll_back();
  q_.close();
  log_.close();
}

map_result<void> map_store::begin(commit_is how) {
  GODWIT_ASSERT(!open_, "map: one transaction at a time");
  if (how != commits_) {
    const auto set =
        file_.db.exec(how == commit_is::synced ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = NORMAL");
    if (!set)
      return tl::unexpected(from_sqlite(set.error(), "setting when to sync"));
    commits_ = how;
  }
  auto begun = io::sqlite::transaction::begin(file_.db);
  if (!begun)
    return tl::unexpected(from_sqlite(begun.error(), "beginning a transaction"));
  open_.emplace(std::move(*begun));
  return {};
}

map_result<void> map_store::apply(const change& work) {
  GODWIT_ASSERT(open_ && !spoilt_, "map: a change needs a transaction that can be committed");
  const auto before = sqlite3_total_changes64(file_.db.handle());
  auto done = work(tables_);
  if (done)
    return done;
  spoilt_ = !is_refusal(done.error().code) || sqlite3_total_changes64(file_.db.handle()) != before;
  return done;
}

map_result<bool> map_store::apply(staged_work& work, decision_context& now) {
  bool finished = false;
  auto done = apply([&](map_tables& t) -> map_result<void> {
    auto staged = work.stage(t, now);
    if (!staged)
      return tl::unexpected(std::move(staged.error()));
    finished = *staged;
    return {};
  });
  if (!done)
    return tl::unexpected(std::move(done.error()));
  return finished;
}

map_result<void> map_store::commit() {
  GODWIT_ASSERT(open_ && !spoilt_, "map: a commit needs a transaction in which nothing went wrong");
  if (auto done = open_->commit(); !done) {
    auto error = from_sqlite(done.error(), "committing");
    roll_back();
    return tl::unexpected(std::move(error));
  }
  open_.reset();
  committed_ = map_;
  return {};
}

void map_store::roll_back() {
  spoilt_ = false;
  if (!open_)
    return;
  open_->rollback();
  open_.reset();
  map_ = committed_; // a disk that fails may not give it
}

map_result<void> map_store::run(staged_work& work) {
  for (;;) {
    decision_context now;
    bool finished = false;
    auto done = begin(commit_of(work)).and_then([&] { return apply(work, now); }).and_then([&](bool last) {
      finished = last;
      return commit();
    });
    if (!done)
      roll_back();
    else
      work.committed();
    if (!done || finished) {
      work.finish(done);
      return done;
    }
  }
}

map_result<std::unique_ptr<pass_review>> map_store::review(const pass_end& pass, pass_review::callback done) const {
  if (auto sound = check(pass); !sound)
    return tl::unexpected(std::move(sound.error()));
  auto reader = open_map_for_reading(options_.file.path, options_.file.vfs);
  if (!reader)
    return tl::unexpected(std::move(reader.error()));
  auto in_view = view_cursor::open(std::move(*reader), pass);
  if (!in_view)
    return tl::unexpected(std::move(in_view.error()));
  return std::make_unique<pass_review>(pass, std::move(*in_view), std::move(done));
}

} // namespace godwit::mapobjects_store
