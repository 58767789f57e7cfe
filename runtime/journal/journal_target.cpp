#include "runtime/journal/journal_target.hpp"

#include <filesystem>
#include <utility>

#include "io/sqlite/bus_guard.hpp"
#include "runtime/journal/journal_file.hpp"
#include "runtime/journal/memory_copy.hpp"
#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

using io::sqlite::store_errc;
using io::sqlite::store_error;
using io::sqlite::store_result;

namespace {

// A dead letter, or the mark that an effect was taken, is true whatever became of the writes before.
bool builds_on_earlier(const journal_write& write) {
  return !write.events.empty() || write.snapshot || !write.effects.empty();
}

} // namespace

journal_target::journal_target(std::string path, io::sqlite::store_file file, std::int64_t checkpoint_bytes,
                               file_maker make_file)
    : checkpoint_bytes_(checkpoint_bytes), make_file_(std::move(make_file)), path_(std::move(path)),
      bus_errors_(io::sqlite::bus_errors()) {
  use(std::move(file));
}

void journal_target::use(io::sqlite::store_file file) {
  file_.emplace(std::move(file));
  store_.emplace(file_->db);
  log_.emplace(file_->db, io::sqlite::log_bounds{checkpoint_bytes_, checkpoint_bytes_});
  watch_.emplace(path_, file_->lock.database_descriptor());
}

void journal_target::leave_file() {
  open_.reset();
  store_.reset();
  log_.reset();
  file_.reset();
}

std::string journal_target::file() const {
  const std::lock_guard guard(path_mutex_);
  return path_;
}

// -- a file that is not what it was ---------------------------------------------------------------

void journal_target::lose(const io::sqlite::file_trouble& why) {
  if (lost_)
    return;
  lost_ = store_error{why.is_whole ? store_errc::missing : store_errc::corrupt, path_,
                      why.what + " while it was written; nothing more is written to it, and what comes waits in memory",
                      "`godwitd ctl rescue-journal` writes all of it to a new file, " + path_ + rescued_suffix};
  is_lost_whole_ = why.is_whole;
  file_->db.leave_log_at_close(); // whoever lies at its name now is none of its business
}

store_result<void> journal_target::look_at_file() {
  const bool was_bus_error = std::exchange(bus_errors_, io::sqlite::bus_errors()) != io::sqlite::bus_errors();
  const auto trouble = lost_ ? std::nullopt : watch_->look();
  if (trouble)
    lose(*trouble);
  else if (was_bus_error) // pages were gone, and are back, empty
    lose({false, "the index of its log was cut"});
  if (lost_)
    return tl::unexpected(*lost_);
  return {};
}

tl::expected<io::sqlite::store_file, journal_error> journal_target::copy_to(const std::string& path) {
  if (is_lost_whole_ && file_->db.exec("VACUUM INTO " + io::sqlite::quoted(path)))
    if (auto copied = make_file_(path))
      return copied;
  auto made = make_file_(path);
  if (!made)
    return made;
  record_store store(made->db);
  auto open = io::sqlite::transaction::begin(made->db);
  const auto doing = [&](const io::sqlite::error& why) {
    return from_store(io::sqlite::describe(why, journal_format().kind, path, "writing what is in memory"));
  };
  if (!open)
    return tl::unexpected(doing(open.error()));
  const auto written = copy_.write_to(store).and_then([&] { return open->commit(); });
  store.close();
  if (!written)
    return tl::unexpected(doing(written.error()));
  return made;
}

tl::expected<std::string, journal_error> journal_target::rescue() {
  if (!lost_)
    return tl::unexpected(journal_error{journal_errc::io, path_,
                                        "the journal is as it should be, and goes on where it is", "Nothing to do."});
  const auto fresh = path_ + rescued_suffix;
  if (std::filesystem::exists(fresh))
    return tl::unexpected(
        journal_error{journal_errc::io, fresh, "it is there already", "Move it away, and try again."});
  auto copied = copy_to(fresh);
  if (!copied)
    return tl::unexpected(std::move(copied.error()));
  leave_file();
  {
    const std::lock_guard guard(path_mutex_);
    path_ = fresh;
  }
  use(*std::move(copied));
  lost_.reset();
  return fresh;
}

// -------------------------------------------------------------------------------------------------

store_error journal_target::describe(const io::sqlite::error& error, const std::string& doing) const {
  return io::sqlite::describe(error, journal_format().kind, path_, doing);
}

bool journal_target::is_write(const journal_item& item) const { return std::holds_alternative<journal_write>(item); }

// New writes of an actor with a failed one fail with it, until it recovers.
void journal_target::arrived(queued_item& item) {
  if (broken_.empty())
    return;
  if (const auto* recovery = std::get_if<queued_recovery>(&item.item)) {
    broken_.erase(recovery->actor);
    return;
  }
  if (!is_write(item.item))
    return;
  const auto& write = std::get<journal_write>(item.item);
  if (!builds_on_earlier(write))
    return;
  if (const auto found = broken_.find(write.actor); found != broken_.end())
    item.failed = found->second;
}

store_result<void> journal_target::begin() {
  if (lost_)
    return tl::unexpected(*lost_);
  auto begun = io::sqlite::transaction::begin(file_->db);
  if (!begun)
    return tl::unexpected(describe(begun.error(), "beginning a transaction"));
  open_.emplace(std::move(*begun));
  return {};
}

store_result<void> journal_target::apply(journal_item& item) {
  const auto& write = std::get<journal_write>(item);
  if (auto applied = store_->apply(write); !applied)
    return tl::unexpected(describe(applied.error(), "writing for actor " + write.actor));
  return {};
}

store_result<void> journal_target::commit() {
  // What was read since may be wrong.
  if (io::sqlite::bus_errors() != bus_errors_)
    if (auto seen = look_at_file(); !seen)
      return seen;
  if (auto committed = open_->commit(); !committed)
    return tl::unexpected(describe(committed.error(), "committing"));
  open_.reset();
  store_->keep_numbers();
  return {};
}

void journal_target::roll_back() {
  open_.reset();
  store_->drop_numbers();
}

// A damaged file too: what waits is not given up before a person has looked.
bool journal_target::may_pass(const store_error& error) const { return error.code != store_errc::misuse; }

// The write and all that its actor wrote after it, up to the actor's next recovery.
void journal_target::failed(backlog& waiting, std::size_t at) {
  const auto actor = std::get<journal_write>(waiting[at].item).actor;
  const auto error = *waiting[at].failed;
  for (auto i = at; i < waiting.size(); ++i) {
    if (const auto* recovery = std::get_if<queued_recovery>(&waiting[i].item)) {
      if (recovery->actor == actor)
        return;
      continue;
    }
    if (!is_write(waiting[i].item))
      continue;
    const auto& write = std::get<journal_write>(waiting[i].item);
    if (write.actor == actor && (i == at || builds_on_earlier(write)))
      waiting[i].failed = error;
  }
  broken_.insert_or_assign(actor, error);
}

void journal_target::finish(journal_item& item, const store_result<void>& result) {
  const auto& write = std::get<journal_write>(item);
  if (result) {
    events_ += write.events.size();
    copy_.note(write);
  }
  if (write.done)
    write.done(result.map_error(from_store));
}

void journal_target::run_barrier(journal_item& barrier, const backlog& waiting, std::size_t ahead) {
  if (auto* wanted = std::get_if<queued_rescue>(&barrier))
    wanted->callback(rescue());
  else
    answer(std::get<queued_recovery>(barrier), waiting, ahead);
}

void journal_target::run(journal_item& barrier) { run_barrier(barrier, {}, 0); }

bool journal_target::run_early(backlog& waiting, std::size_t at) {
  run_barrier(waiting[at].item, waiting, at);
  return true;
}

void journal_target::answer(queued_recovery& recovery, const backlog& waiting, std::size_t ahead) {
  auto state = lost_ ? copy_.of(recovery.actor) : store_->read(recovery.actor);
  if (!state) {
    recovery.callback(tl::unexpected(from_store(describe(state.error(), "recovering actor " + recovery.actor))));
    return;
  }
  if (!lost_)
    copy_.take(recovery.actor, *state);
  for (std::size_t i = 0; i < ahead; ++i) {
    const auto* write = std::get_if<journal_write>(&waiting[i].item);
    if (write != nullptr && !waiting[i].failed && write->actor == recovery.actor)
      lay_over(*state, *write);
  }
  recovery.callback(std::move(*state));
}

void journal_target::give_up(journal_item& item, const std::optional<store_error>& why) {
  auto error = closed_journal(path_);
  if (why)
    error.what = "it was closed with this undone; the last error: " + from_store(*why).message();
  if (auto* recovery = std::get_if<queued_recovery>(&item))
    recovery->callback(tl::unexpected(error));
  else if (auto* wanted = std::get_if<queued_rescue>(&item))
    wanted->callback(tl::unexpected(error));
  else if (auto& write = std::get<journal_write>(item); write.done)
    write.done(tl::unexpected(error));
}

void journal_target::close() {
  if (!lost_)
    log_->close();
  leave_file();
}

} // namespace godwit::runtime
