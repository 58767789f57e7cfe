#include "runtime/journal/journal_target.hpp"

#include "runtime/journal/overlay.hpp"
#include "runtime/journal/schema.hpp"
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

journal_target::journal_target(std::string path, io::sqlite::database db, std::int64_t checkpoint_bytes)
    : path_(std::move(path)), db_(std::move(db)), store_(db_) {
  log_.emplace(db_, io::sqlite::log_bounds{checkpoint_bytes, checkpoint_bytes});
}

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
  const auto& write = std::get<journal_write>(item.item);
  if (!builds_on_earlier(write))
    return;
  if (const auto found = broken_.find(write.actor); found != broken_.end())
    item.failed = found->second;
}

store_result<void> journal_target::begin() {
  auto begun = io::sqlite::transaction::begin(db_);
  if (!begun)
    return tl::unexpected(describe(begun.error(), "beginning a transaction"));
  open_.emplace(std::move(*begun));
  return {};
}

store_result<void> journal_target::apply(journal_item& item) {
  const auto& write = std::get<journal_write>(item);
  if (auto applied = store_.apply(write); !applied)
    return tl::unexpected(describe(applied.error(), "writing for actor " + write.actor));
  return {};
}

store_result<void> journal_target::commit() {
  if (auto committed = open_->commit(); !committed)
    return tl::unexpected(describe(committed.error(), "committing"));
  open_.reset();
  store_.keep_numbers();
  return {};
}

void journal_target::roll_back() {
  open_.reset();
  store_.drop_numbers();
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
    const auto& write = std::get<journal_write>(waiting[i].item);
    if (write.actor == actor && (i == at || builds_on_earlier(write)))
      waiting[i].failed = error;
  }
  broken_.insert_or_assign(actor, error);
}

void journal_target::finish(journal_item& item, const store_result<void>& result) {
  const auto& write = std::get<journal_write>(item);
  if (result)
    events_ += write.events.size();
  if (write.done)
    write.done(result.map_error(from_store));
}

void journal_target::run(journal_item& recovery) { answer(std::get<queued_recovery>(recovery), {}, 0); }

bool journal_target::run_early(backlog& waiting, std::size_t at) {
  answer(std::get<queued_recovery>(waiting[at].item), waiting, at);
  return true;
}

void journal_target::answer(queued_recovery& recovery, const backlog& waiting, std::size_t ahead) {
  auto state = store_.read(recovery.actor);
  if (!state) {
    recovery.callback(tl::unexpected(from_store(describe(state.error(), "recovering actor " + recovery.actor))));
    return;
  }
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
  else if (auto& write = std::get<journal_write>(item); write.done)
    write.done(tl::unexpected(error));
}

void journal_target::close() {
  store_.close();
  log_->close();
  log_.reset();
  db_.close();
}

} // namespace godwit::runtime
