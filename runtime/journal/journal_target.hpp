// What the journal's writer does with what waits: writes commit in groups, recoveries are answered between them.
//
// A write whose statement is wrong (a mistake of its program) fails alone; it and the later writes of its actor fail
// until that actor recovers, because they build on what never became durable. While the disk fails, recoveries are
// answered from the database plus the waiting writes. Thread: the writer's; events may be asked from any.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "io/sqlite/group_target.hpp"
#include "io/sqlite/log_keeper.hpp"
#include "io/sqlite/transaction.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/journal/record_store.hpp"

namespace godwit::runtime {

struct queued_recovery {
  std::string actor;
  journal::recovered_callback callback;
};

using journal_item = std::variant<journal_write, queued_recovery>;
using queued_item = io::sqlite::queued<journal_item>;

class journal_target final : public io::sqlite::group_target<journal_item> {
public:
  // The log is moved into the database when it is longer than CHECKPOINT_BYTES.
  journal_target(std::string path, io::sqlite::database db, std::int64_t checkpoint_bytes);

  [[nodiscard]] std::uint64_t events() const { return events_; } // that reached the disk

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
  void close() override;

private:
  [[nodiscard]] io::sqlite::store_error describe(const io::sqlite::error& error, const std::string& doing) const;
  void answer(queued_recovery& recovery, const backlog& waiting, std::size_t ahead);

  const std::string path_;
  io::sqlite::database db_;
  std::optional<io::sqlite::log_keeper> log_; // until close
  record_store store_;
  std::optional<io::sqlite::transaction> open_;
  std::unordered_map<std::string, io::sqlite::store_error> broken_; // actors with a failed write, until they recover
  std::atomic<std::uint64_t> events_{0};
};

} // namespace godwit::runtime
