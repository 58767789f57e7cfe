#include "runtime/journal/journal_reader.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace {

using namespace godwit::runtime;

class load_stage_test : public ::testing::Test {
protected:
  load_stage_test() {
    options.path = folder.path("journal.db");
    options.tables = {{"staged",
                       {"CREATE TABLE staged(generation INTEGER, n INTEGER); "
                        "CREATE TABLE shown(generation INTEGER); INSERT INTO shown VALUES (0)"}}};
    journal = open_journal(options);
  }

  bulk_load rows(std::int64_t count, std::promise<commit_result>& done) {
    bulk_load load;
    load.name = "staged";
    load.next = [count, next = std::int64_t{0}](std::vector<row_change>& chunk, std::size_t max_rows) mutable {
      for (std::size_t i = 0; i < max_rows && next < count; ++i)
        chunk.push_back({"INSERT INTO staged VALUES (1, ?)", {next++}});
      return next < count;
    };
    load.flip = {{"UPDATE shown SET generation = ?", {std::int64_t{1}}}};
    load.done = [&done](const commit_result& result) { done.set_value(result); };
    return load;
  }

  std::int64_t count(const std::string& sql) {
    return journal_reader::open(options.path)->database().query_integer(sql).value();
  }

  scratch_folder folder;
  journal_options options;
  std::unique_ptr<sqlite_journal> journal;
};

TEST_F(load_stage_test, all_rows_come_and_the_flip_is_last) {
  std::promise<commit_result> done;
  journal->load(rows(25'000, done));
  ASSERT_TRUE(done.get_future().get());
  EXPECT_EQ(count("SELECT count(*) FROM staged"), 25'000);
  EXPECT_EQ(count("SELECT generation FROM shown"), 1);
  EXPECT_GE(journal->status().commits, 26U) << "in chunks of at most 1000 rows";
}

TEST_F(load_stage_test, a_write_does_not_wait_for_the_load) {
  std::promise<commit_result> done;
  auto finished = done.get_future();
  const auto began = std::chrono::steady_clock::now();
  journal->load(rows(300'000, done));
  std::int64_t committed = 0;
  std::chrono::steady_clock::duration longest{};
  while (finished.wait_for(std::chrono::seconds(0)) != std::future_status::ready && committed < 200) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(commit(*journal, event_write("a", ++committed)));
    longest = std::max(longest, std::chrono::steady_clock::now() - start);
  }
  EXPECT_GE(committed, 20) << "commits passed while the load ran";
  ASSERT_TRUE(finished.get());
  EXPECT_LT(longest, (std::chrono::steady_clock::now() - began) / 2) << "of the time that the load took";
}

TEST_F(load_stage_test, a_load_ends_while_writes_never_cease) {
  std::atomic<bool> stop{false};
  std::function<void(std::int64_t)> go_on = [&](std::int64_t number) {
    auto write = event_write("a", number);
    write.done = [&, number](const commit_result&) {
      if (!stop)
        go_on(number + 1);
    };
    static_cast<void>(journal->submit(std::move(write)));
  };
  go_on(1);
  std::promise<commit_result> done;
  journal->load(rows(300, done));
  EXPECT_TRUE(done.get_future().get());
  stop = true;
  ASSERT_TRUE(journal->flush(std::chrono::seconds(5)));
  journal->close();
}

TEST_F(load_stage_test, a_wrong_statement_ends_the_load_before_its_flip) {
  std::promise<commit_result> done;
  auto load = rows(10, done);
  load.next = [](std::vector<row_change>& chunk, std::size_t) {
    chunk.push_back({"INSERT INTO nowhere VALUES (1)", {}});
    return false;
  };
  journal->load(std::move(load));
  const auto result = done.get_future().get();
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("nowhere"), std::string::npos);
  EXPECT_EQ(count("SELECT generation FROM shown"), 0);
  EXPECT_TRUE(commit(*journal, event_write("a", 1)));
}

TEST_F(load_stage_test, closing_ends_a_load_with_an_error_and_without_its_flip) {
  std::promise<commit_result> done;
  journal->load(rows(100'000'000, done));
  ASSERT_TRUE(wait_for([&] { return journal->status().commits > 2; }));
  journal->close();
  EXPECT_EQ(done.get_future().get().error().code, journal_errc::closed);
  EXPECT_EQ(count("SELECT generation FROM shown"), 0);
}

TEST_F(load_stage_test, loads_are_bounded_in_number) {
  std::promise<commit_result> first;
  journal->load(rows(100'000'000, first));
  std::vector<std::promise<commit_result>> others(options.max_queued_loads);
  for (auto& other : others)
    journal->load(rows(1, other));
  EXPECT_EQ(others.back().get_future().get().error().code, journal_errc::queue_full);
  journal->close();
}

} // namespace
} // namespace godwit::tests
