// What the journal's writer does with what waits: writes commit in groups, recoveries are answered between them.
//
// A write whose statement is wrong (a mistake of its program) fails alone; it and the later writes of its actor fail
// until that actor recovers, because they build on what never became durable. While the disk fails, recoveries are
// answered from the database plus the waiting writes.
//
//   [whole] --deleted, replaced or cut--> [lost] --a person says so--> [whole, in PATH.rescued]
//
// While it is lost nothing is written: what comes waits in memory, and recoveries are answered from the copy there.
// Thread: the writer's; events may be asked from any.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "io/sqlite/database.hpp"
#include "io/sqlite/file_watch.hpp"
#include "io/sqlite/group_target.hpp"
#include "io/sqlite/log_keeper.hpp"
#include "io/sqlite/store_file.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/journal/memory_copy.hpp"
#include "runtime/journal/record_store.hpp"

namespace godwit::runtime {

struct queued_recovery {
  std::string actor;
  journal::recovered_callback callback;
};

// Somebody wants the journal written to a new file.
struct queued_rescue {
  std::function<void(tl::expected<std::string, journal_error>)> callback; // the new file
};

using journal_item = std::variant<journal_write, queued_recovery, queued_rescue>;
using queued_item = io::sqlite::queued<journal_item>;

class journal_target final : public io::sqlite::group_target<journal_item> {
public:
  using file_maker = std::function<tl::expected<io::sqlite::store_file, journal_error>(const std::string& path)>;

  // The log is moved into the database when it is longer than CHECKPOINT_BYTES. MAKE_FILE opens or makes a journal.
  journal_target(std::string path, io::sqlite::store_file file, std::int64_t checkpoint_bytes, file_maker make_file);

  [[nodiscard]] std::uint64_t events() const { return events_; } // that reached the disk
  [[nodiscard]] std::string file() const;                        // where it writes now

  [[nodiscard]] bool is_write(const journal_item& item) const override;
  void arrived(queued_item& item) override;
  [[nodiscard]] io::sqlite::store_result<void> begin() override;
  [[nodiscard]] io::sqlite::store_result<void> apply(journal_item& item) override;
  [[nodiscard]] io::sqlite::store_result<void> commit() override;
  void roll_back() override;
  [[nodiscard]] bool may_pass(const io::sqlite::store_error& error) const override;
  void failed(backlog& waiting, std::size_t at) override;
  void finish(journal_item& item, const io::sqlite::store_result<void>& result) override;
  void run(journal_item& recovery) override;
  bool run_early(backlog& waiting, std::size_t at) override;
  void give_up(journal_item& item, const std::optional<io::sqlite::store_error>& why) override;
  void look_after_log(bool busy) override { log_->look_after(busy); }
  [[nodiscard]] io::sqlite::store_result<void> look_at_file() override;
  void close() override;

private:
  [[nodiscard]] io::sqlite::store_error describe(const io::sqlite::error& error, const std::string& doing) const;
  void answer(queued_recovery& recovery, const backlog& waiting, std::size_t ahead);
  void run_barrier(journal_item& barrier, const backlog& waiting, std::size_t ahead);

  void use(io::sqlite::store_file file);
  void leave_file();
  void lose(const io::sqlite::file_trouble& why);
  [[nodiscard]] tl::expected<std::string, journal_error> rescue();
  [[nodiscard]] tl::expected<io::sqlite::store_file, journal_error> copy_to(const std::string& path);

  const std::int64_t checkpoint_bytes_;
  const file_maker make_file_;
  mutable std::mutex path_mutex_; // for file(); the writer reads without
  std::string path_;
  std::optional<io::sqlite::store_file> file_; // until close
  std::optional<io::sqlite::log_keeper> log_;
  std::optional<record_store> store_;
  std::optional<io::sqlite::file_watch> watch_;
  std::uint64_t bus_errors_ = 0;
  memory_copy copy_;
  std::optional<io::sqlite::store_error> lost_;
  bool is_lost_whole_ = false; // what is open can still be read
  std::optional<io::sqlite::transaction> open_;
  std::unordered_map<std::string, io::sqlite::store_error> broken_; // actors with a failed write, until they recover
  std::atomic<std::uint64_t> events_{0};
};

} // namespace godwit::runtime
