#include "programs/godwit-drill/flight_simulation/stored_disk.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "actors/executor/state.hpp"
#include "actors/operator_bridge/audit_table.hpp"
#include "runtime/assert.hpp"
#include "runtime/journal/sqlite_journal.hpp"
#include "runtime/stored_state.hpp"

namespace godwit::drill {

namespace {

using io::sqlite::fault_kind;
using io::sqlite::fault_vfs;

// In a journal with a thread a recovery is not among what waits: nobody has to ask for it. Here somebody has to.
class journal_file final : public runtime::file_below, private runtime::journal {
public:
  explicit journal_file(const runtime::journal_options& options) {
    auto opened = runtime::sqlite_journal::open(options);
    GODWIT_ASSERT(opened.has_value(), "drill: the journal opens, whatever was done to its disk");
    journal_ = std::move(*opened);
  }
  // As SIGKILL: nothing of what waits comes to the disk, and nothing is tidied up.
  ~journal_file() override {
    fault_vfs::instance().arm({.kind = fault_kind::io_error, .at = 1, .from_then_on = true});
    journal_.reset();
    fault_vfs::instance().disarm();
  }

  [[nodiscard]] runtime::journal& writer() override { return *this; }
  void run_once() override { journal_->run_once(); }

private:
  [[nodiscard]] tl::expected<void, runtime::journal_error> submit(runtime::journal_write&& write) override {
    return journal_->submit(std::move(write));
  }
  void recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) override {
    ++recoveries_;
    journal_->recover(std::move(actor), incarnation, [this, callback = std::move(callback)](auto found) {
      --recoveries_;
      callback(std::move(found));
    });
  }
  [[nodiscard]] runtime::journal_status status() const override {
    auto result = journal_->status();
    result.queued += recoveries_;
    return result;
  }

  std::uint64_t recoveries_ = 0; // that wait
  std::unique_ptr<runtime::sqlite_journal> journal_;
};

} // namespace

stored_disk::stored_disk(std::string path, std::function<std::int64_t()> now_ns)
    : path_(std::move(path)), now_ns_(std::move(now_ns)) {
  fault_vfs::instance().disarm();
  fault_vfs::instance().track_unsynced();
}

stored_disk::~stored_disk() { fault_vfs::instance().disarm(); }

std::unique_ptr<runtime::file_below> stored_disk::open() {
  runtime::journal_options options;
  options.path = path_;
  options.tables = {operator_bridge::audit_table()};
  options.vfs = fault_vfs::name;
  options.own_thread = false;
  options.clock = [this] { return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(now_ns_())); };
  return std::make_unique<journal_file>(options);
}

void stored_disk::fail(const io::sqlite::fault_plan& how) { fault_vfs::instance().arm(how); }

void stored_disk::mend() { fault_vfs::instance().disarm(); }

bool stored_disk::has_failed() const { return fault_vfs::instance().injected(); }

void stored_disk::lose_power(std::uint64_t seed) {
  fault_vfs::instance().cut_power(seed);
  fault_vfs::instance().track_unsynced();
}

intent_on_disk read_intent(const runtime::recovered& executor, std::int64_t since_ns) {
  using executor::durable_core;
  executor::state found;
  if (executor.snapshot)
    found = runtime::read_state<durable_core>("executor", *executor.snapshot);
  intent_on_disk result;
  const auto add_open = [&] {
    result.brings_plan = result.brings_plan || found.progress.upload.has_value();
    result.starts = result.starts || found.progress.start.has_value();
  };
  for (const auto& each : executor.events) {
    if (std::ranges::find(durable_core::retired, each.type) != durable_core::retired.end())
      continue;
    (void)durable_core::apply(found, runtime::read_alternative<durable_core::event>("executor", each.type, each.body),
                              each.at_ns);
    if (each.at_ns >= since_ns)
      add_open();
  }
  add_open();
  return result;
}

} // namespace godwit::drill
