#include "runtime/journal/sqlite_journal.hpp"

#include <algorithm>
#include <unordered_map>

#include "io/sqlite/group_writer.hpp"
#include "runtime/journal/journal_target.hpp"
#include "runtime/journal/records.hpp"
#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::refusal;

journal_error refused(refusal why, const std::string& path, const std::string& actor) {
  switch (why) {
  case refusal::not_admitted:
    return {journal_errc::stale_incarnation, path,
            "actor " + actor + " has been restarted; this is its older incarnation",
            "Nothing to do: the new incarnation goes on from what was durable."};
  case refusal::full:
    return {journal_errc::queue_full, path, "the writer is late by its bound",
            "Look at the journal's health: the disk is failing or too slow."};
  case refusal::closed:
    break;
  }
  return closed_journal(path);
}

} // namespace

struct sqlite_journal::parts {
  parts(const journal_options& options, io::sqlite::store_file file, std::uint64_t run_number)
      : path(options.path), run(run_number),
        target(path, std::move(file), static_cast<std::int64_t>(options.checkpoint_bytes),
               [vfs = options.vfs, tables = options.tables](const std::string& other) {
                 return open_for_writing({other, vfs, true, integrity_check::quick, tables});
               }),
        writer({.queue = {options.max_queued_writes, options.max_queued_bytes},
                .group = {options.max_group_writes, options.max_group_bytes},
                .retry = {options.retry_min, options.retry_max},
                .close_timeout = options.close_timeout,
                .clock = options.clock,
                .on_health_change =
                    [this, told = options.on_health_change] {
                      if (told)
                        told(status());
                    }},
               target) {}

  [[nodiscard]] journal_status status() const;

  const std::string path;
  const std::uint64_t run;
  // The first incarnation of each actor that may still write; one entry for each actor that recovered. Guarded by the
  // writer's queue: submit and recover look at it when they are admitted.
  std::unordered_map<std::string, std::uint64_t> first_valid;
  journal_target target;
  io::sqlite::group_writer<journal_item> writer;
};

journal_status sqlite_journal::parts::status() const {
  const auto now = writer.status();
  journal_status result;
  result.failing = now.counts.last_error.has_value();
  result.reason = result.failing ? from_store(*now.counts.last_error).message() : "";
  result.commits = now.counts.commits;
  result.writes = now.counts.written;
  result.events = target.events();
  result.retries = now.counts.retries;
  result.refused = now.queue.refused;
  result.queued = now.queue.items;
  result.fill = now.queue.fill;
  result.run = run;
  if (const auto in_use = target.file(); !result.failing && in_use.ends_with(rescued_suffix))
    result.reason = "it is written to " + in_use + "; after the flight look what became of the old one, and put this " +
                    "one in its place while godwitd does not run";
  return result;
}

sqlite_journal::sqlite_journal(std::unique_ptr<parts> made) : parts_(std::move(made)) {}

tl::expected<std::unique_ptr<sqlite_journal>, journal_error> sqlite_journal::open(const journal_options& options) {
  auto file = open_for_writing({options.path, options.vfs, options.create, options.check, options.tables});
  if (!file)
    return tl::unexpected(std::move(file.error()));
  const auto run = file->db.query_integer("SELECT value FROM meta WHERE name = 'run'");
  if (!run)
    return tl::unexpected(from_sqlite(run.error(), options.path, "reading the number of this run"));
  auto made = std::make_unique<parts>(options, std::move(*file), static_cast<std::uint64_t>(*run));
  if (options.own_thread)
    made->writer.start();
  return std::unique_ptr<sqlite_journal>(new sqlite_journal(std::move(made)));
}

sqlite_journal::~sqlite_journal() { close(); }

tl::expected<void, journal_error> sqlite_journal::submit(journal_write&& write) {
  const io::sqlite::queue_room room{.items = 1, .bytes = bytes_of(write)};
  journal_item item(std::move(write));
  const auto may_write = [this](const journal_item& asked) {
    const auto& by = std::get<journal_write>(asked);
    const auto found = parts_->first_valid.find(by.actor);
    return found == parts_->first_valid.end() || by.incarnation >= found->second;
  };
  const auto taken = parts_->writer.push(std::move(item), room, may_write);
  if (taken)
    return {};
  write = std::move(std::get<journal_write>(item)); // NOLINT(bugprone-use-after-move): what is refused stays as it was
  return tl::unexpected(refused(taken.error(), parts_->path, write.actor));
}

void sqlite_journal::recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) {
  const auto fence_older = [&](const journal_item& asked) {
    auto& first = parts_->first_valid[std::get<queued_recovery>(asked).actor];
    first = std::max(first, incarnation);
    return true;
  };
  journal_item item(queued_recovery{std::move(actor), std::move(callback)});
  if (!parts_->writer.push(std::move(item), {.items = 0, .bytes = 0}, fence_older))
    std::get<queued_recovery>(item).callback( // NOLINT(bugprone-use-after-move): as above
        tl::unexpected(closed_journal(parts_->path)));
}

void sqlite_journal::rescue(rescued_callback callback) {
  journal_item item(queued_rescue{std::move(callback)});
  const auto admitted = [](const journal_item&) { return true; };
  if (!parts_->writer.push(std::move(item), {.items = 0, .bytes = 0}, admitted)) {
    std::get<queued_rescue>(item).callback( // NOLINT(bugprone-use-after-move): as above
        tl::unexpected(closed_journal(parts_->path)));
    return;
  }
  // The next commit says that all is well again.
  (void)parts_->writer.push(journal_item(journal_write{}), {.items = 0, .bytes = 0}, admitted);
}

journal_status sqlite_journal::status() const { return parts_->status(); }

bool sqlite_journal::flush(std::chrono::milliseconds timeout) { return parts_->writer.flush(timeout); }

void sqlite_journal::run_once() { parts_->writer.run_once(); }

void sqlite_journal::close() { parts_->writer.close(); }

} // namespace godwit::runtime
