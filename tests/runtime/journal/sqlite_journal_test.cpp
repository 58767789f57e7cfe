#include <algorithm>
#include <thread>

#include "runtime/journal/journal_reader.hpp"
#include "runtime/journal/record_store.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace sqlite_journal_test {

using namespace godwit::runtime;

class sqlite_journal_test : public ::testing::Test {
protected:
  journal_options options() const { return {.path = folder.path("journal.db")}; }

  scratch_folder folder;
};

TEST_F(sqlite_journal_test, makes_the_folder_and_the_file_where_nothing_is) {
  auto journal = open_journal({.path = folder.path("a/b/journal.db")});
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->status().run, 1U);
  using std::filesystem::perms;
  const auto mode = std::filesystem::status(folder.path("a/b/journal.db")).permissions();
  EXPECT_EQ(mode, perms::owner_read | perms::owner_write);
}

TEST_F(sqlite_journal_test, the_run_rises_with_each_opening) {
  for (std::uint64_t run = 1; run <= 3; ++run)
    EXPECT_EQ(open_journal(options())->status().run, run);
}

TEST_F(sqlite_journal_test, what_was_committed_is_recovered_after_reopening) {
  {
    auto journal = open_journal(options());
    for (std::int64_t n = 1; n <= 10; ++n) {
      auto write = event_write("executor", n);
      write.effects = {effect_of(n, 0), effect_of(n, 1)};
      if (n > 1)
        write.released = {{n - 1, 0}};
      write.seen = {{"vehicle_link", {n, 3}}};
      if (n == 7)
        write.snapshot = snapshot_record{n, 5, 2, "{\"phase\":\"flying\"}"};
      ASSERT_TRUE(commit(*journal, std::move(write)));
    }
  }
  auto journal = open_journal(options());
  const auto state = recover(*journal, "executor");
  ASSERT_TRUE(state);
  ASSERT_TRUE(state->snapshot);
  EXPECT_EQ(state->snapshot->number, 7);
  EXPECT_EQ(state->snapshot->version, 2);
  EXPECT_EQ(state->snapshot->body, "{\"phase\":\"flying\"}");
  EXPECT_EQ(state->durable_upto, 10) << "without it the next incarnation lets nothing out";
  ASSERT_EQ(state->events.size(), 3U);
  EXPECT_EQ(state->events[0].number, 8);
  EXPECT_EQ(state->events[2].body, "{\"n\":10}");
  EXPECT_EQ(state->last_event, 10);
  ASSERT_EQ(state->effects.size(), 11U); // n = 1 of each event, and n = 0 of the last
  EXPECT_EQ(state->effects[0].id, (effect_id{1, 1}));
  EXPECT_EQ(state->effects[9].id, (effect_id{10, 0}));
  EXPECT_EQ(state->effects[9].answer_to, 7U);
  ASSERT_EQ(state->seen.size(), 1U);
  EXPECT_EQ(state->seen[0].upto, (effect_id{10, 3}));
}

TEST_F(sqlite_journal_test, numbers_go_on_after_a_snapshot_has_deleted_all_events) {
  {
    auto journal = open_journal(options());
    auto write = event_write("a", 1);
    write.snapshot = snapshot_record{1, 1, 1, "{}"};
    ASSERT_TRUE(commit(*journal, std::move(write)));
  }
  auto journal = open_journal(options());
  EXPECT_EQ(recover(*journal, "a")->last_event, 1);
  EXPECT_TRUE(recover(*journal, "a")->events.empty());
  EXPECT_TRUE(commit(*journal, event_write("a", 2)));
}

TEST_F(sqlite_journal_test, an_unknown_actor_recovers_empty) {
  auto journal = open_journal(options());
  const auto state = recover(*journal, "nobody");
  ASSERT_TRUE(state);
  EXPECT_FALSE(state->snapshot);
  EXPECT_EQ(state->last_event, 0);
}

TEST_F(sqlite_journal_test, texts_keep_zero_bytes_quotes_and_emptiness) {
  auto journal = open_journal(options());
  auto write = event_write("it's", 1);
  write.events.front().body = std::string("a\0b'\"", 5);
  write.events.front().type = "";
  ASSERT_TRUE(commit(*journal, std::move(write)));
  const auto state = recover(*journal, "it's");
  EXPECT_EQ(state->events.at(0).body, std::string("a\0b'\"", 5));
  EXPECT_EQ(state->events.at(0).type, "");
}

TEST_F(sqlite_journal_test, a_recovery_contains_what_was_submitted_before_it) {
  auto journal = open_journal(options());
  for (int round = 0; round < 50; ++round) {
    const auto actor = "actor " + std::to_string(round);
    for (std::int64_t n = 1; n <= 20; ++n)
      ASSERT_TRUE(journal->submit(event_write(actor, n)));
    EXPECT_EQ(recover(*journal, actor)->last_event, 20);
  }
}

TEST_F(sqlite_journal_test, done_is_called_in_the_order_of_submission) {
  auto journal = open_journal(options());
  std::vector<std::int64_t> order; // written by the writer thread only, read after flush
  for (std::int64_t n = 1; n <= 5'000; ++n) {
    auto write = event_write("a", n);
    write.done = [&order, n](const commit_result&) { order.push_back(n); };
    ASSERT_TRUE(journal->submit(std::move(write)));
  }
  ASSERT_TRUE(journal->flush(std::chrono::seconds(20)));
  ASSERT_EQ(order.size(), 5'000U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  const auto status = journal->status();
  EXPECT_EQ(status.events, 5'000U);
  EXPECT_EQ(status.writes, 5'000U);
  EXPECT_LT(status.commits, 2'500U) << "writes that wait together share a transaction";
  EXPECT_EQ(status.queued, 0U);
}

TEST_F(sqlite_journal_test, writes_of_many_threads_all_become_durable) {
  constexpr int threads = 8;
  constexpr std::int64_t events = 200;
  {
    auto journal = open_journal(options());
    std::vector<std::thread> submitters;
    for (int i = 0; i < threads; ++i)
      submitters.emplace_back([&, i] {
        for (std::int64_t n = 1; n <= events; ++n)
          EXPECT_TRUE(commit(*journal, event_write("actor " + std::to_string(i), n)));
      });
    for (auto& submitter : submitters)
      submitter.join();
  }
  auto journal = open_journal(options());
  for (int i = 0; i < threads; ++i)
    EXPECT_EQ(recover(*journal, "actor " + std::to_string(i))->events.size(), static_cast<std::size_t>(events));
}

TEST_F(sqlite_journal_test, a_write_of_an_older_incarnation_is_refused_after_its_successor_asked) {
  auto journal = open_journal(options());
  ASSERT_TRUE(commit(*journal, event_write("a", 1, 1)));
  ASSERT_TRUE(recover(*journal, "a", 2));
  const auto refused = journal->submit(event_write("a", 2, 1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, journal_errc::stale_incarnation);
  EXPECT_EQ(journal->status().refused, 1U);
  EXPECT_TRUE(commit(*journal, event_write("a", 2, 2)));
  EXPECT_TRUE(commit(*journal, event_write("b", 1, 1))) << "other actors are not concerned";
}

TEST_F(sqlite_journal_test, a_closed_journal_takes_nothing_and_says_so) {
  auto journal = open_journal(options());
  journal->close();
  const auto refused = journal->submit(event_write("a", 1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, journal_errc::closed);
  EXPECT_EQ(recover(*journal, "a").error().code, journal_errc::closed);
  journal->close(); // a second time does nothing
}

TEST_F(sqlite_journal_test, closing_writes_what_waits_and_leaves_one_file_and_the_lock) {
  {
    auto journal = open_journal(options());
    for (std::int64_t n = 1; n <= 3'000; ++n)
      ASSERT_TRUE(journal->submit(event_write("a", n)));
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("journal.db-wal")));
  EXPECT_EQ(recover(*open_journal(options()), "a")->last_event, 3'000);
}

TEST_F(sqlite_journal_test, the_log_stays_short_while_it_is_written) {
  auto opts = options();
  opts.checkpoint_bytes = 256 * 1024;
  auto journal = open_journal(opts);
  for (std::int64_t n = 1; n <= 400; ++n) {
    auto write = event_write("a", n);
    write.snapshot = snapshot_record{n, n, 1, std::string(16 * 1024, 's')};
    ASSERT_TRUE(commit(*journal, std::move(write)));
  }
  EXPECT_LT(std::filesystem::file_size(folder.path("journal.db-wal")), 1024U * 1024U) << "7 MB went through it";
}

TEST_F(sqlite_journal_test, a_write_with_a_wrong_statement_fails_alone) {
  auto opts = options();
  opts.tables = {{"numbers", {"CREATE TABLE numbers(n INTEGER)"}}};
  auto journal = open_journal(opts);
  auto wrong = event_write("wrong", 1);
  wrong.rows = {{"INSERT INTO no_such_table VALUES (?)", {std::int64_t{1}}}};
  std::vector<std::future<commit_result>> right;
  right.push_back(submit(*journal, event_write("right", 1)));
  auto first_wrong = submit(*journal, std::move(wrong));
  auto second_wrong = submit(*journal, event_write("wrong", 2));
  auto with_row = event_write("right", 2);
  with_row.rows = {{"INSERT INTO numbers VALUES (?)", {std::int64_t{1}}}};
  right.push_back(submit(*journal, std::move(with_row)));
  for (auto& result : right)
    EXPECT_TRUE(result.get());
  const auto failed = first_wrong.get();
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, journal_errc::io);
  EXPECT_NE(failed.error().what.find("no_such_table"), std::string::npos) << failed.error().message();
  EXPECT_FALSE(second_wrong.get()) << "it builds on what never became durable";
  EXPECT_FALSE(journal->status().failing);
  EXPECT_EQ(recover(*journal, "wrong", 2)->last_event, 0);
  EXPECT_TRUE(commit(*journal, event_write("wrong", 1, 2))) << "its next incarnation goes on";
}

TEST_F(sqlite_journal_test, a_statement_that_would_end_the_transaction_is_refused) {
  auto journal = open_journal(options());
  std::int64_t n = 0;
  for (const auto* sql : {"COMMIT", "ROLLBACK", "SELECT 1", "INSERT INTO meta VALUES ('x', 1); COMMIT"}) {
    auto write = event_write("a", 1, static_cast<std::uint64_t>(++n));
    write.rows = {{sql, {}}};
    EXPECT_FALSE(commit(*journal, std::move(write))) << sql;
    EXPECT_EQ(recover(*journal, "a", static_cast<std::uint64_t>(n + 1))->last_event, 0) << sql;
  }
  auto wrong_count = event_write("b", 1);
  wrong_count.rows = {{"INSERT INTO meta VALUES (?, ?)", {std::int64_t{1}}}};
  EXPECT_FALSE(commit(*journal, std::move(wrong_count)));
}

TEST_F(sqlite_journal_test, an_outbox_row_is_replaced_by_its_key_and_commits_with_its_event) {
  auto journal = open_journal(options());
  auto first = event_write("mission_client", 1);
  first.outbox = {
      {.idempotency_key = "k1", .destination = "progress", .body = "{}", .created_ns = 5, .last_error = ""}};
  ASSERT_TRUE(commit(*journal, std::move(first)));
  auto second = event_write("mission_client", 2);
  second.outbox = {{.idempotency_key = "k1",
                    .destination = "progress",
                    .body = "{}",
                    .created_ns = 5,
                    .state = delivery_state::delivered,
                    .tries = 3,
                    .last_error = "503",
                    .next_try_ns = 9,
                    .first_failure_ns = 8}};
  second.dead_letters = {{1, 2, 3, "sender", "type", "{}", 3, "threw"}};
  ASSERT_TRUE(commit(*journal, std::move(second)));
  auto reader = journal_reader::open(options().path);
  ASSERT_TRUE(reader);
  const auto rows = *reader->outbox("mission_client");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].state, delivery_state::delivered);
  EXPECT_EQ(rows[0].tries, 3);
  EXPECT_EQ(rows[0].last_error, "503");
  const auto letters = *reader->dead_letters("mission_client");
  ASSERT_EQ(letters.size(), 1U);
  EXPECT_EQ(letters[0].reason, "threw");
}

TEST_F(sqlite_journal_test, of_one_actors_dead_letters_the_newest_are_kept) {
  auto journal = open_journal(options());
  auto other = event_write("b", 1);
  other.dead_letters = {{1, 2, 3, "sender", "type", "{}", 3, "threw"}};
  ASSERT_TRUE(commit(*journal, std::move(other)));
  auto many = event_write("a", 1);
  for (std::int64_t i = 0; i < max_dead_letters; ++i)
    many.dead_letters.push_back({static_cast<std::uint64_t>(i), 2, 3, "sender", "type", "{}", 3, "threw"});
  ASSERT_TRUE(commit(*journal, std::move(many)));
  auto more = event_write("a", 2);
  more.dead_letters = {{5'000, 2, 3, "sender", "type", "{}", 3, "threw"}};
  ASSERT_TRUE(commit(*journal, std::move(more)));
  auto reader = journal_reader::open(options().path);
  ASSERT_TRUE(reader);
  const auto letters = *reader->dead_letters("a");
  ASSERT_EQ(letters.size(), static_cast<std::size_t>(max_dead_letters));
  EXPECT_TRUE(std::none_of(letters.begin(), letters.end(), [](const auto& each) { return each.message_id == 0; }));
  EXPECT_TRUE(std::any_of(letters.begin(), letters.end(), [](const auto& each) { return each.message_id == 5'000; }));
  EXPECT_EQ(reader->dead_letters("b")->size(), 1U);
}

TEST_F(sqlite_journal_test, the_queue_is_bounded_in_writes_and_in_bytes) {
  auto opts = options();
  opts.max_queued_bytes = 64 * 1024;
  auto journal = open_journal(opts);
  auto large = event_write("a", 1);
  large.events.front().body = std::string(65 * 1024, 'x');
  const auto refused = journal->submit(std::move(large));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, journal_errc::queue_full);
  EXPECT_TRUE(commit(*journal, event_write("a", 1))) << "nothing of the refused write was taken";
}

using sqlite_journal_death_test = sqlite_journal_test;

TEST_F(sqlite_journal_death_test, an_event_number_that_does_not_follow_is_a_broken_invariant) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        auto journal = open_journal(options());
        static_cast<void>(commit(*journal, event_write("a", 2)));
      },
      "event 2 of actor a follows event 0");
}

} // namespace sqlite_journal_test
} // namespace godwit::tests
