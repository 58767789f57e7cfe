// The writer while the disk refuses: nothing is acknowledged, recoveries are answered, everything goes on afterwards.
#include "io/sqlite/fault_vfs.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace journal_target_test {

using io::sqlite::fault_kind;
using io::sqlite::fault_vfs;
using namespace godwit::runtime;
using namespace std::chrono_literals;

class failing_disk_test : public ::testing::Test {
protected:
  failing_disk_test() {
    options.path = folder.path("journal.db");
    options.vfs = fault_vfs::name;
    options.retry_min = 1ms;
    options.retry_max = 20ms;
    options.close_timeout = 100ms;
    options.on_health_change = [this](const journal_status& status) { (status.failing ? turned_red : turned_green)++; };
    fault_vfs::instance().disarm();
    journal = open_journal(options);
  }
  ~failing_disk_test() override {
    fault_vfs::instance().disarm();
    journal.reset();
  }

  void break_disk(fault_kind kind = fault_kind::disk_full) { fault_vfs::instance().arm({kind, 1, true}); }
  void heal_disk() { fault_vfs::instance().disarm(); }
  bool pending(const std::future<commit_result>& result) { return result.wait_for(0s) == std::future_status::timeout; }

  std::atomic<int> turned_red{0};
  std::atomic<int> turned_green{0};
  scratch_folder folder;
  journal_options options;
  std::unique_ptr<sqlite_journal> journal;
};

TEST_F(failing_disk_test, nothing_is_acknowledged_while_it_fails_and_everything_once_it_works) {
  ASSERT_TRUE(commit(*journal, event_write("a", 1)));
  break_disk();
  auto second = submit(*journal, event_write("a", 2));
  auto third = submit(*journal, event_write("a", 3));
  ASSERT_TRUE(wait_for([&] { return journal->status().retries > 3; }));
  EXPECT_TRUE(pending(second) && pending(third));
  const auto status = journal->status();
  EXPECT_TRUE(status.failing);
  EXPECT_NE(status.reason.find("disk is full"), std::string::npos) << status.reason;
  EXPECT_NE(status.reason.find(options.path), std::string::npos) << status.reason;
  EXPECT_EQ(status.queued, 2U);
  EXPECT_EQ(turned_red, 1);
  heal_disk();
  EXPECT_TRUE(second.get());
  EXPECT_TRUE(third.get());
  EXPECT_FALSE(journal->status().failing);
  EXPECT_TRUE(journal->status().reason.empty());
  EXPECT_EQ(turned_red, 1);
  EXPECT_EQ(turned_green, 1);
}

TEST_F(failing_disk_test, a_recovery_is_answered_from_the_database_and_what_waits) {
  auto first = event_write("a", 1);
  first.effects = {effect_of(1, 0), effect_of(1, 1)};
  first.seen = {{"s", {1, 0}}};
  ASSERT_TRUE(commit(*journal, std::move(first)));
  break_disk(fault_kind::io_error);
  auto second = event_write("a", 2);
  second.released = {{1, 0}};
  second.effects = {effect_of(2, 0)};
  second.seen = {{"r", {4, 0}}, {"s", {0, 9}}};
  auto waiting = submit(*journal, std::move(second));
  auto other = submit(*journal, event_write("b", 1));
  const auto state = recover(*journal, "a", 2);
  ASSERT_TRUE(state) << state.error().message();
  EXPECT_TRUE(pending(waiting));
  EXPECT_EQ(state->last_event, 2);
  EXPECT_EQ(state->events.size(), 2U);
  ASSERT_EQ(state->effects.size(), 2U);
  EXPECT_EQ(state->effects[0].id, (effect_id{1, 1}));
  EXPECT_EQ(state->effects[1].id, (effect_id{2, 0}));
  ASSERT_EQ(state->seen.size(), 2U);
  EXPECT_EQ(state->seen[1].upto, (effect_id{1, 0})) << "a mark never goes back";
  // The new incarnation goes on at once; its writes wait after the others.
  auto third = event_write("a", 3, 2);
  third.snapshot = snapshot_record{3, 3, 1, "{}"};
  auto third_result = submit(*journal, std::move(third));
  const auto later = recover(*journal, "a", 3);
  ASSERT_TRUE(later);
  EXPECT_EQ(later->last_event, 3);
  EXPECT_TRUE(later->events.empty());
  heal_disk();
  EXPECT_TRUE(waiting.get());
  EXPECT_TRUE(other.get());
  EXPECT_TRUE(third_result.get());
  const auto resolved = recover(*journal, "a", 4);
  EXPECT_EQ(resolved->last_event, 3);
  EXPECT_EQ(resolved->effects.size(), later->effects.size());
  EXPECT_EQ(resolved->seen.size(), later->seen.size());
}

TEST_F(failing_disk_test, the_queue_refuses_at_its_bound_and_takes_again_afterwards) {
  journal.reset();
  options.max_queued_writes = 10;
  journal = open_journal(options);
  break_disk();
  std::vector<std::future<commit_result>> waiting;
  for (std::int64_t n = 1; n <= 10; ++n)
    waiting.push_back(submit(*journal, event_write("a", n)));
  const auto refused = journal->submit(event_write("a", 11));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, journal_errc::queue_full);
  heal_disk();
  for (auto& result : waiting)
    EXPECT_TRUE(result.get());
  EXPECT_TRUE(wait_for([&] { return journal->status().queued == 0; }));
  EXPECT_TRUE(commit(*journal, event_write("a", 11)));
}

TEST_F(failing_disk_test, closing_is_bounded_and_tells_each_write_that_it_is_undone) {
  break_disk(fault_kind::io_error);
  auto undone = submit(*journal, event_write("a", 1));
  const auto start = std::chrono::steady_clock::now();
  journal->close();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
  const auto result = undone.get();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, journal_errc::closed);
  EXPECT_NE(result.error().what.find("disk reported an error"), std::string::npos) << result.error().message();
}

TEST_F(failing_disk_test, closing_tries_once_more_at_once) {
  journal.reset();
  options.retry_min = options.retry_max = 60s;
  options.close_timeout = 5s;
  journal = open_journal(options);
  break_disk();
  auto write = submit(*journal, event_write("a", 1));
  ASSERT_TRUE(wait_for([&] { return journal->status().failing; }));
  heal_disk();
  journal->close();
  EXPECT_TRUE(write.get());
}

TEST_F(failing_disk_test, a_wrong_statement_found_while_it_fails_is_left_out_of_recoveries) {
  break_disk();
  auto right = submit(*journal, event_write("right", 1));
  auto wrong = event_write("wrong", 1);
  wrong.rows = {{"INSERT INTO no_such_table VALUES (1)", {}}};
  auto wrong_result = submit(*journal, std::move(wrong));
  ASSERT_TRUE(wait_for([&] { return journal->status().retries > 3; }));
  EXPECT_EQ(recover(*journal, "wrong", 2)->last_event, 0);
  auto after_it = submit(*journal, event_write("wrong", 1, 2));
  heal_disk();
  EXPECT_TRUE(right.get());
  EXPECT_FALSE(wrong_result.get());
  EXPECT_TRUE(after_it.get());
}

TEST_F(failing_disk_test, a_wrong_statement_found_afterwards_takes_along_what_was_built_on_it) {
  journal.reset();
  options.max_group_writes = 1; // the disk fails before the wrong one gets its turn
  journal = open_journal(options);
  break_disk();
  auto right = submit(*journal, event_write("right", 1));
  auto wrong = event_write("wrong", 1);
  wrong.rows = {{"INSERT INTO no_such_table VALUES (1)", {}}};
  auto wrong_result = submit(*journal, std::move(wrong));
  ASSERT_TRUE(wait_for([&] { return journal->status().retries > 1; }));
  // Nobody can know yet that it is wrong: the successor builds on it and fails too, and its own successor is sound.
  EXPECT_EQ(recover(*journal, "wrong", 2)->last_event, 1);
  auto built_on_it = submit(*journal, event_write("wrong", 2, 2));
  heal_disk();
  EXPECT_TRUE(right.get());
  EXPECT_FALSE(wrong_result.get());
  EXPECT_FALSE(built_on_it.get());
  EXPECT_EQ(recover(*journal, "wrong", 3)->last_event, 0);
  EXPECT_TRUE(commit(*journal, event_write("wrong", 1, 3)));
}

} // namespace journal_target_test
} // namespace godwit::tests
