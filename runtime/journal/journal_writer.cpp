#include "runtime/journal/journal_writer.hpp"

#include <algorithm>

#include <sqlite3.h>

#include "io/sqlite/transaction.hpp"
#include "io/sqlite/write_ahead_log.hpp"
#include "runtime/journal/overlay.hpp"
#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using std::chrono::steady_clock;

// A load gets one chunk in this time even while writes never cease, so that it ends at all.
constexpr std::chrono::milliseconds load_patience{100};

} // namespace

journal_writer::journal_writer(writer_options options, io::sqlite::database db, std::uint64_t run_number,
                               write_queue& queue)
    : options_(std::move(options)), db_(std::move(db)), store_(db_), queue_(queue), retry_delay_(options_.retry_min) {
  status_.run = run_number;
  const auto page_bytes = db_.query_integer("PRAGMA page_size").value_or(4096);
  checkpoint_step_frames_ =
      std::max(1, static_cast<int>(static_cast<std::int64_t>(options_.checkpoint_bytes) / page_bytes));
  checkpoint_at_frames_ = checkpoint_step_frames_;
  sqlite3_wal_hook(db_.handle(), &journal_writer::count_frames, this);
  // Only for speed: with a disk too full for it the journal still works while commits fit.
  const auto room_bytes = static_cast<std::int64_t>(options_.checkpoint_bytes + options_.checkpoint_bytes / 4);
  static_cast<void>(io::sqlite::reserve_log(db_, room_bytes));
}

void journal_writer::run() {
  for (;;) {
    std::deque<bulk_load> new_loads;
    const bool closing = queue_.take(backlog_, new_loads, next_turn());
    for (auto& load : new_loads)
      loads_.emplace_back(std::move(load), options_.chunk);
    mark_arrivals();
    if (must_stop(closing))
      break;
    if (!status_.failing || steady_clock::now() >= next_try_)
      work();
    if (status_.failing)
      answer_while_failing();
  }
  give_up_rest();
  // Everything moves into the database file; where a reader or the disk prevents it, the log stays and is read at the
  // next start.
  sqlite3_wal_hook(db_.handle(), nullptr, nullptr);
  static_cast<void>(db_.exec("PRAGMA wal_checkpoint(TRUNCATE)"));
  store_.close();
  db_.close();
}

// When to look again even if nothing arrives; nothing = only then.
std::optional<journal_writer::time_point> journal_writer::next_turn() const {
  if (backlog_.empty() && loads_.empty() && !close_deadline_)
    return std::nullopt;
  if (!status_.failing)
    return time_point{};
  return close_deadline_ ? std::min(next_try_, *close_deadline_) : next_try_;
}

bool journal_writer::must_stop(bool closing) {
  if (!closing)
    return false;
  const auto now = steady_clock::now();
  if (!close_deadline_) {
    close_deadline_ = now + options_.close_timeout;
    next_try_ = now;
    retry_delay_ = options_.retry_min;
  }
  return backlog_.empty() || now >= *close_deadline_; // a load can be made again; closing does not wait for it
}

void journal_writer::work() {
  if (!backlog_.empty()) {
    if (auto* recovery = std::get_if<queued_recovery>(&backlog_.front())) {
      answer(*recovery, 0);
      backlog_.pop_front();
      --marked_;
    } else {
      commit_group();
    }
  }
  const bool load_waits_long = steady_clock::now() - last_chunk_ > load_patience;
  const bool writes_wait = !backlog_.empty() || queue_.has_arrivals();
  if (!loads_.empty() && (!writes_wait || (load_waits_long && !status_.failing)))
    stage_load();
  checkpoint_when_long();
}

void journal_writer::give_up_rest() {
  auto error = closed_journal(options_.path);
  if (status_.failing)
    error.what = "it was closed with this undone; the last error: " + status_.reason;
  const commit_result closed = tl::unexpected(error);
  for (auto& item : backlog_) {
    if (auto* recovery = std::get_if<queued_recovery>(&item)) {
      recovery->callback(tl::unexpected(error));
      continue;
    }
    auto& write = std::get<queued_write>(item);
    if (write.write.done)
      write.write.done(closed);
    queue_.finished(1, write.bytes);
  }
  backlog_.clear();
  for (const auto& load : loads_)
    load.finish(closed);
  loads_.clear();
}

// The longest run of writes at the head of the backlog within the bounds of a group; at least one.
std::size_t journal_writer::group_size() const {
  std::size_t size = 0;
  std::size_t bytes = 0;
  while (size < backlog_.size() && size < options_.max_group_writes) {
    const auto* write = std::get_if<queued_write>(&backlog_[size]);
    if (write == nullptr || (size > 0 && bytes + write->bytes > options_.max_group_bytes))
      break;
    bytes += write->bytes;
    ++size;
  }
  return size;
}

void journal_writer::commit_group() {
  const auto size = group_size();
  auto outcome = group_outcome::one_is_wrong;
  while (outcome == group_outcome::one_is_wrong) // at most once for each actor in the group
    outcome = try_group(size);
  if (outcome == group_outcome::committed)
    finish_group(size);
}

journal_writer::group_outcome journal_writer::try_group(std::size_t size) {
  auto change = io::sqlite::transaction::begin(db_);
  if (!change)
    return group_failed(change.error(), size);
  for (std::size_t i = 0; i < size; ++i) {
    auto& item = std::get<queued_write>(backlog_[i]);
    if (item.failed)
      continue;
    auto applied = store_.apply(item.write);
    if (applied)
      continue;
    change->rollback();
    if (!io::sqlite::is_programming_error(applied.error()))
      return group_failed(applied.error(), size);
    store_.drop_numbers();
    fail_write(i, from_sqlite(applied.error(), options_.path, "writing for actor " + item.write.actor));
    return group_outcome::one_is_wrong;
  }
  if (auto committed = change->commit(); !committed)
    return group_failed(committed.error(), size);
  store_.keep_numbers();
  return group_outcome::committed;
}

journal_writer::group_outcome journal_writer::group_failed(const io::sqlite::error& error, std::size_t size) {
  store_.drop_numbers();
  disk_failed(error, "committing " + std::to_string(size) + (size == 1 ? " write" : " writes"));
  return group_outcome::disk_error;
}

void journal_writer::finish_group(std::size_t size) {
  disk_works();
  std::size_t bytes = 0;
  {
    std::lock_guard lock(status_mutex_);
    ++status_.commits;
    for (std::size_t i = 0; i < size; ++i) {
      const auto& item = std::get<queued_write>(backlog_[i]);
      bytes += item.bytes;
      status_.writes += item.failed ? 0 : 1;
      status_.events += !item.failed && item.write.event ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    const auto& item = std::get<queued_write>(backlog_[i]);
    if (item.write.done)
      item.write.done(item.failed ? commit_result(tl::unexpected(*item.failed)) : commit_result());
  }
  backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(size));
  marked_ -= size;
  queue_.finished(size, bytes);
}

// The write and all that its actor wrote after it, up to the actor's next recovery.
void journal_writer::fail_write(std::size_t index, const journal_error& error) {
  const std::string actor = std::get<queued_write>(backlog_[index]).write.actor;
  for (auto i = index; i < backlog_.size(); ++i) {
    if (const auto* recovery = std::get_if<queued_recovery>(&backlog_[i])) {
      if (recovery->actor == actor)
        return;
      continue;
    }
    auto& item = std::get<queued_write>(backlog_[i]);
    if (item.write.actor == actor)
      item.failed = error;
  }
  broken_.insert_or_assign(actor, error);
}

// New writes of an actor with a failed one fail with it, until it recovers.
void journal_writer::mark_arrivals() {
  for (; marked_ < backlog_.size(); ++marked_) {
    if (broken_.empty())
      continue;
    if (const auto* recovery = std::get_if<queued_recovery>(&backlog_[marked_])) {
      broken_.erase(recovery->actor);
      continue;
    }
    auto& item = std::get<queued_write>(backlog_[marked_]);
    if (const auto found = broken_.find(item.write.actor); found != broken_.end())
      item.failed = found->second;
  }
}

void journal_writer::answer(queued_recovery& recovery, std::size_t writes_before) {
  auto state = store_.read(recovery.actor);
  if (!state) {
    const auto error = from_sqlite(state.error(), options_.path, "recovering actor " + recovery.actor);
    recovery.callback(tl::unexpected(error));
    return;
  }
  for (std::size_t i = 0; i < writes_before; ++i) {
    const auto* item = std::get_if<queued_write>(&backlog_[i]);
    if (item != nullptr && !item->failed && item->write.actor == recovery.actor)
      lay_over(*state, item->write);
  }
  recovery.callback(std::move(*state));
}

void journal_writer::answer_while_failing() {
  for (std::size_t i = 0; i < backlog_.size();) {
    auto* recovery = std::get_if<queued_recovery>(&backlog_[i]);
    if (recovery == nullptr) {
      ++i;
      continue;
    }
    answer(*recovery, i);
    backlog_.erase(backlog_.begin() + static_cast<std::ptrdiff_t>(i));
    --marked_;
  }
}

void journal_writer::stage_load() {
  last_chunk_ = steady_clock::now();
  auto& load = loads_.front();
  const auto doing = "loading " + load.name();
  auto change = io::sqlite::transaction::begin(db_);
  if (!change)
    return disk_failed(change.error(), doing);
  auto staged = load.stage(store_, [&] { return queue_.has_arrivals(); });
  if (!staged && io::sqlite::is_programming_error(staged.error())) {
    change->rollback();
    return finish_load(tl::unexpected(from_sqlite(staged.error(), options_.path, doing)));
  }
  if (staged)
    staged = change->commit();
  if (!staged)
    return disk_failed(staged.error(), doing);
  load.committed();
  disk_works();
  {
    std::lock_guard lock(status_mutex_);
    ++status_.commits;
  }
  if (load.complete())
    finish_load({});
}

void journal_writer::finish_load(const commit_result& result) {
  loads_.front().finish(result);
  loads_.pop_front();
  queue_.load_finished();
}

void journal_writer::disk_failed(const io::sqlite::error& error, const std::string& doing) {
  const bool again = status_.failing;
  journal_status changed;
  {
    std::lock_guard lock(status_mutex_);
    ++status_.retries;
    status_.failing = true;
    status_.reason = from_sqlite(error, options_.path, doing).message();
    changed = status_;
  }
  next_try_ = steady_clock::now() + retry_delay_;
  retry_delay_ = std::min(retry_delay_ * 2, options_.retry_max);
  if (!again && options_.on_health_change)
    options_.on_health_change(changed);
}

void journal_writer::disk_works() {
  if (!status_.failing)
    return;
  journal_status changed;
  {
    std::lock_guard lock(status_mutex_);
    status_.failing = false;
    status_.reason.clear();
    changed = status_;
  }
  retry_delay_ = options_.retry_min;
  if (options_.on_health_change)
    options_.on_health_change(changed);
}

// Moves the log into the database file, as far as readers allow. An error here hurts nobody: the rows are safe in the
// log. It is tried again when the log has grown by another step; a disk that refuses everything shows up in the next
// commit.
void journal_writer::checkpoint_when_long() {
  if (log_frames_ < checkpoint_at_frames_ || status_.failing)
    return;
  int in_log = 0;
  int moved = 0;
  const int code = sqlite3_wal_checkpoint_v2(db_.handle(), "main", SQLITE_CHECKPOINT_PASSIVE, &in_log, &moved);
  const bool whole = code == SQLITE_OK && in_log == moved;
  checkpoint_at_frames_ = whole ? checkpoint_step_frames_ : log_frames_ + checkpoint_step_frames_;
  log_frames_ = 0; // the next commit says how long it is then
}

int journal_writer::count_frames(void* self, sqlite3*, const char*, int frames) {
  static_cast<journal_writer*>(self)->log_frames_ = frames;
  return SQLITE_OK;
}

journal_status journal_writer::status() const {
  std::lock_guard lock(status_mutex_);
  auto result = status_;
  result.refused = queue_.refused();
  result.queued = queue_.queued();
  return result;
}

} // namespace godwit::runtime
