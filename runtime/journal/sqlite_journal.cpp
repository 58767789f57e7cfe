#include "runtime/journal/sqlite_journal.hpp"

#include <mutex>
#include <thread>

#include "runtime/assert.hpp"
#include "runtime/journal/journal_writer.hpp"
#include "runtime/journal/lock_file.hpp"
#include "runtime/journal/sqlite_error.hpp"
#include "runtime/journal/write_queue.hpp"

namespace godwit::runtime {

namespace {

writer_options writer_options_of(const journal_options& options) {
  return {.path = options.path,
          .max_group_writes = options.max_group_writes,
          .max_group_bytes = options.max_group_bytes,
          .checkpoint_bytes = options.checkpoint_bytes,
          .retry_min = options.retry_min,
          .retry_max = options.retry_max,
          .close_timeout = options.close_timeout,
          .chunk = {options.max_chunk_rows, options.max_chunk_time},
          .on_health_change = options.on_health_change};
}

journal_error refusal(journal_errc code, const std::string& path, const std::string& who) {
  switch (code) {
  case journal_errc::stale_incarnation:
    return {code, path, who + " has been restarted; this is its older incarnation",
            "Nothing to do: the new incarnation goes on from what was durable."};
  case journal_errc::queue_full:
    return {code, path, "the writer is behind by its bound",
            "Look at the journal's health: the disk is failing or too slow."};
  default:
    return closed_journal(path);
  }
}

} // namespace

struct sqlite_journal::parts {
  parts(const journal_options& options, lock_file held, io::sqlite::database db, std::uint64_t run)
      : path(options.path), lock(std::move(held)),
        queue({options.max_queued_writes, options.max_queued_bytes, options.max_queued_loads}),
        writer(writer_options_of(options), std::move(db), run, queue) {}

  std::string path;
  lock_file lock;
  write_queue queue;
  journal_writer writer;
  std::mutex close_mutex;
  std::thread thread;
};

sqlite_journal::sqlite_journal(std::unique_ptr<parts> made) : parts_(std::move(made)) {
  parts_->thread = std::thread([this] { parts_->writer.run(); });
}

tl::expected<std::unique_ptr<sqlite_journal>, journal_error> sqlite_journal::open(const journal_options& options) {
  if (auto made = make_folder_of(options.path); !made)
    return tl::unexpected(std::move(made.error()));
  auto lock = lock_file::acquire(options.path);
  if (!lock)
    return tl::unexpected(std::move(lock.error()));
  auto db = open_for_writing({options.path, options.vfs, options.create, options.check, options.tables});
  if (!db)
    return tl::unexpected(std::move(db.error()));
  const auto run = db->query_integer("SELECT value FROM meta WHERE name = 'run'");
  if (!run)
    return tl::unexpected(from_sqlite(run.error(), options.path, "reading the number of this run"));
  auto made = std::make_unique<parts>(options, std::move(*lock), std::move(*db), static_cast<std::uint64_t>(*run));
  return std::unique_ptr<sqlite_journal>(new sqlite_journal(std::move(made)));
}

sqlite_journal::~sqlite_journal() { close(); }

tl::expected<void, journal_error> sqlite_journal::submit(journal_write write) {
  auto taken = parts_->queue.push(std::move(write));
  if (!taken)
    // push() leaves what it refuses as it was.
    return tl::unexpected(
        refusal(taken.error(), parts_->path, "actor " + write.actor)); // NOLINT(bugprone-use-after-move)
  return {};
}

void sqlite_journal::recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) {
  queued_recovery recovery{std::move(actor), std::move(callback)};
  if (!parts_->queue.push(std::move(recovery), incarnation))
    recovery.callback(tl::unexpected(closed_journal(parts_->path))); // NOLINT(bugprone-use-after-move): as above
}

void sqlite_journal::load(bulk_load load) {
  auto taken = parts_->queue.push(std::move(load));
  if (!taken && load.done) // NOLINT(bugprone-use-after-move): as above
    load.done(tl::unexpected(refusal(taken.error(), parts_->path, "load " + load.name)));
}

journal_status sqlite_journal::status() const { return parts_->writer.status(); }

bool sqlite_journal::flush(std::chrono::milliseconds timeout) { return parts_->queue.wait_until_finished(timeout); }

void sqlite_journal::close() {
  GODWIT_ASSERT(std::this_thread::get_id() != parts_->thread.get_id(), "journal: closed from one of its own callbacks");
  parts_->queue.close();
  std::lock_guard one_at_a_time(parts_->close_mutex);
  if (!parts_->thread.joinable())
    return;
  parts_->thread.join();
  parts_->lock.release(); // after the writer has closed the database
}

} // namespace godwit::runtime
