#include <future>
#include <set>

#include <gtest/gtest.h>

#include "io/sqlite/database.hpp"
#include "io/sqlite/group_writer.hpp"
#include "io/sqlite/log_keeper.hpp"
#include "tests/io/sqlite/store_fixture.hpp"

namespace godwit::tests {

namespace group_writer_test {

using namespace io::sqlite;
using namespace std::chrono_literals;

// A line to be written, or (with an empty text) a barrier.
struct note {
  std::string text;
  std::function<void(const store_result<void>&)> done = {};
};

// Writes notes; the text is unique, so that a repetition can never commit.
class notebook final : public group_target<note> {
public:
  explicit notebook(store_file file) : file_(std::move(file)), log_(file_.db, {4'000'000, 4'000'000}) {}

  [[nodiscard]] bool is_write(const note& item) const override { return !item.text.empty(); }
  [[nodiscard]] store_result<void> begin() override {
    auto begun = transaction::begin(file_.db);
    if (!begun)
      return told(begun.error());
    open_.emplace(std::move(*begun));
    return {};
  }
  [[nodiscard]] store_result<void> apply(note& item) override {
    auto insert = file_.db.prepare("INSERT INTO note(text) VALUES (?)");
    auto done = insert ? insert->with(item.text).run() : tl::unexpected(insert.error());
    return done ? store_result<void>() : told(done.error());
  }
  [[nodiscard]] store_result<void> commit() override {
    auto done = open_->commit();
    open_.reset();
    return done ? store_result<void>() : told(done.error());
  }
  void roll_back() override { open_.reset(); }
  void finish(note& item, const store_result<void>& result) override { tell(item, result); }
  void run(note& barrier) override { tell(barrier, {}); }
  bool run_early(backlog& waiting, std::size_t at) override {
    if (early)
      tell(waiting[at].item, {});
    return early;
  }
  void give_up(note& item, const std::optional<store_error>&) override {
    tell(item, tl::unexpected(store_error{.code = store_errc::locked, .file = {}, .what = "closed", .remedy = {}}));
  }
  [[nodiscard]] bool has_turn() override { return turns > 0; }
  [[nodiscard]] store_result<bool> take_turn(const std::function<bool()>&) override {
    --turns;
    return true;
  }
  void look_after_log(bool busy) override { log_.look_after(busy); }
  void close() override { ++closed; }

  bool early = false;
  int turns = 0;
  int closed = 0;

private:
  static store_result<void> told(const error& error) {
    return tl::unexpected(describe(error, note_format().kind, "notes.db", "writing"));
  }
  static void tell(const note& item, const store_result<void>& result) {
    if (item.done)
      item.done(result);
  }

  store_file file_;
  log_keeper log_;
  std::optional<transaction> open_;
};

class group_writer_test : public store_test {
protected:
  group_writer_test() : book(open()) {
    wanted.clock = [this] { return now; };
    wanted.on_health_change = [this] { ++health_changes; };
    wanted.queue.max_items = 10;
    make();
  }
  ~group_writer_test() override { fault_vfs::instance().disarm(); }

  void make() { writer.emplace(wanted, book); }
  bool push(const std::string& text, std::size_t bytes = 1) {
    return writer
        ->push({text,
                [this, text](const store_result<void>& result) {
                  (result ? written : failed).push_back(text);
                  if (!result)
                    why = result.error();
                }},
               {.items = 1, .bytes = bytes})
        .has_value();
  }
  static void break_disk(fault_kind kind) { fault_vfs::instance().arm({kind, 1, true}); }
  static void heal_disk() { fault_vfs::instance().disarm(); }

  using texts = std::vector<std::string>;

  notebook book;
  writer_options wanted;
  std::chrono::steady_clock::time_point now{1h};
  texts written;
  texts failed;
  store_error why;
  int health_changes = 0;
  std::optional<group_writer<note>> writer; // tells of the rest when it is closed
};

TEST_F(group_writer_test, what_waits_is_one_transaction_and_is_told_after_it) {
  for (const auto* text : {"a", "b", "c"})
    ASSERT_TRUE(push(text));
  EXPECT_TRUE(written.empty());
  writer->run_once();
  EXPECT_EQ(written, (texts{"a", "b", "c"}));
  EXPECT_EQ(writer->status().counts.commits, 1U);
  EXPECT_EQ(writer->status().counts.written, 3U);
  EXPECT_EQ(rows(), 3);
}

TEST_F(group_writer_test, a_group_is_bounded_in_items_and_in_bytes) {
  wanted.group = {.max_items = 3, .max_bytes = 10};
  make();
  for (const auto* text : {"a", "b", "c", "d"})
    push(text);
  writer->run_once();
  EXPECT_EQ(written.size(), 3U) << "items";
  push("e", 9);
  push("f", 1);
  writer->run_once();
  EXPECT_EQ(written.size(), 5U) << "bytes";
  push("g", 100);
  writer->run_once();
  writer->run_once();
  EXPECT_EQ(written.size(), 7U) << "at least one";
}

TEST_F(group_writer_test, one_that_can_never_commit_fails_alone) {
  for (const auto* text : {"a", "b", "a", "c"})
    push(text);
  writer->run_once();
  EXPECT_EQ(written, (texts{"a", "b", "c"}));
  EXPECT_EQ(failed, texts{"a"});
  EXPECT_EQ(why.code, store_errc::misuse);
  EXPECT_NE(why.what.find("UNIQUE"), std::string::npos) << why.what;
  EXPECT_EQ(rows(), 3);
  EXPECT_FALSE(writer->status().counts.failing_since) << "it is no fault of the disk";
}

TEST_F(group_writer_test, a_group_of_nothing_but_wrong_ones_ends) {
  push("a");
  writer->run_once();
  for (int i = 0; i < 5; ++i)
    push("a");
  writer->run_once();
  EXPECT_EQ(failed.size(), 5U);
  EXPECT_EQ(writer->status().queue.items, 0U);
}

class group_writer_disk_test : public group_writer_test, public ::testing::WithParamInterface<fault_kind> {};

TEST_P(group_writer_disk_test, is_tried_for_ever_at_a_slower_pace_and_loses_nothing) {
  push("a");
  push("b");
  break_disk(GetParam());
  const auto began = now;
  std::vector<std::int64_t> waits_ms;
  for (int i = 0; i < 12; ++i) {
    writer->run_once();
    waits_ms.push_back(std::chrono::duration_cast<std::chrono::milliseconds>(*writer->next_run() - now).count());
    now = *writer->next_run();
  }
  EXPECT_EQ(waits_ms, (std::vector<std::int64_t>{10, 20, 40, 80, 160, 320, 640, 1280, 2000, 2000, 2000, 2000}));
  EXPECT_TRUE(written.empty() && failed.empty()) << "nobody hears anything";
  EXPECT_EQ(writer->status().counts.failing_since, began);
  EXPECT_EQ(writer->status().counts.retries, 12U);
  EXPECT_EQ(health_changes, 1);
  heal_disk();
  writer->run_once();
  EXPECT_EQ(written, (texts{"a", "b"}));
  EXPECT_FALSE(writer->status().counts.failing_since);
  EXPECT_EQ(health_changes, 2);
  EXPECT_EQ(rows(), 2);
}

INSTANTIATE_TEST_SUITE_P(each, group_writer_disk_test,
                         ::testing::Values(fault_kind::io_error, fault_kind::disk_full, fault_kind::torn_write),
                         [](const auto& fault) {
                           return fault.param == fault_kind::io_error    ? "io_error"
                                  : fault.param == fault_kind::disk_full ? "disk_full"
                                                                         : "torn_write";
                         });

TEST_F(group_writer_test, a_file_that_another_program_holds_is_waited_for) {
  auto other = database::open(path(), {});
  ASSERT_TRUE(other && other->exec("BEGIN IMMEDIATE"));
  push("a");
  writer->run_once();
  EXPECT_TRUE(writer->status().counts.failing_since);
  EXPECT_EQ(writer->status().counts.last_error->what.find("another program holds the file"), 0U);
  ASSERT_TRUE(other->exec("COMMIT"));
  now = *writer->next_run();
  writer->run_once();
  EXPECT_EQ(written, texts{"a"});
}

TEST_F(group_writer_test, no_try_is_made_before_its_time) {
  push("a");
  break_disk(fault_kind::io_error);
  writer->run_once();
  heal_disk();
  writer->run_once();
  EXPECT_TRUE(written.empty());
  now += 10ms;
  writer->run_once();
  EXPECT_EQ(written, texts{"a"});
}

TEST_F(group_writer_test, a_wrong_one_found_on_a_failing_disk_is_told_when_its_group_commits) {
  push("a");
  push("a");
  break_disk(fault_kind::disk_full);
  writer->run_once();
  EXPECT_TRUE(failed.empty());
  heal_disk();
  now = *writer->next_run();
  writer->run_once();
  EXPECT_EQ(written, texts{"a"});
  EXPECT_EQ(failed, texts{"a"});
}

TEST_F(group_writer_test, the_fill_of_a_failing_writer_rises_to_its_bound_where_it_refuses) {
  break_disk(fault_kind::disk_full);
  std::set<int> nearly_full_from;
  for (int i = 1; i <= 10; ++i) {
    EXPECT_TRUE(push(std::to_string(i)));
    writer->run_once();
    if (writer->status().queue.fill >= nearly_full)
      nearly_full_from.insert(i);
  }
  EXPECT_EQ(nearly_full_from, (std::set<int>{8, 9, 10}));
  EXPECT_FALSE(push("11"));
  EXPECT_EQ(writer->status().queue.refused, 1U);
  heal_disk();
  now += 2s;
  writer->run_once();
  EXPECT_EQ(written.size(), 10U);
  EXPECT_EQ(writer->status().queue.fill, 0);
  EXPECT_TRUE(push("11"));
}

TEST_F(group_writer_test, a_barrier_runs_when_all_before_it_is_durable) {
  std::int64_t rows_seen = -1;
  push("a");
  ASSERT_TRUE(writer->push({"", [&](const auto&) { rows_seen = rows(); }}, {.items = 0}));
  push("b");
  writer->run_once();
  EXPECT_EQ(rows_seen, -1);
  writer->run_once();
  EXPECT_EQ(rows_seen, 1);
  EXPECT_EQ(written, (texts{"a", "b"}));
}

TEST_F(group_writer_test, a_barrier_that_may_runs_early_while_the_disk_fails) {
  int ran = 0;
  push("a");
  ASSERT_TRUE(writer->push({"", [&](const auto&) { ++ran; }}, {.items = 0}));
  break_disk(fault_kind::io_error);
  writer->run_once();
  EXPECT_EQ(ran, 0);
  book.early = true;
  writer->run_once();
  EXPECT_EQ(ran, 1);
  EXPECT_TRUE(written.empty());
}

TEST_F(group_writer_test, long_work_gets_a_turn_when_nothing_waits_or_once_in_100_ms) {
  book.turns = 3;
  writer->run_once();
  EXPECT_EQ(book.turns, 2);
  push("a");
  writer->run_once();
  EXPECT_EQ(book.turns, 2);
  EXPECT_EQ(written, texts{"a"});
  now += 101ms;
  push("b");
  writer->run_once();
  EXPECT_EQ(book.turns, 1);
  EXPECT_EQ(written, texts{"a"});
}

TEST_F(group_writer_test, flush_writes_all_and_says_when_the_disk_fails) {
  wanted.group.max_items = 1;
  make();
  push("a");
  push("b");
  EXPECT_TRUE(writer->flush(0ms));
  EXPECT_EQ(written, (texts{"a", "b"}));
  push("c");
  break_disk(fault_kind::disk_full);
  EXPECT_FALSE(writer->flush(0ms));
}

TEST_F(group_writer_test, closing_writes_what_waits_and_refuses_what_comes) {
  push("a");
  writer->close();
  EXPECT_EQ(written, texts{"a"});
  EXPECT_EQ(writer->push({"b"}).error(), refusal::closed);
  writer->close(); // a second time does nothing
  EXPECT_EQ(book.closed, 1);
}

TEST_F(group_writer_test, closing_on_a_failing_disk_tries_once_more_and_tells_the_rest) {
  push("a");
  break_disk(fault_kind::io_error);
  writer->run_once();
  const auto retries = writer->status().counts.retries;
  writer->close();
  EXPECT_EQ(writer->status().counts.retries, retries + 1);
  EXPECT_EQ(failed, texts{"a"});
  EXPECT_EQ(why.what, "closed");
}

TEST_F(group_writer_test, a_thread_does_the_same) {
  wanted.clock = &std::chrono::steady_clock::now;
  make();
  writer->start();
  std::promise<void> done;
  ASSERT_TRUE(push("a"));
  ASSERT_TRUE(writer->push({"b", [&](const auto&) { done.set_value(); }}));
  EXPECT_EQ(done.get_future().wait_for(60s), std::future_status::ready);
  EXPECT_TRUE(writer->flush(60s));
  push("c");
  writer->close();
  EXPECT_EQ(rows(), 3);
  EXPECT_EQ(written, (texts{"a", "c"}));
}

} // namespace group_writer_test

} // namespace godwit::tests

namespace godwit::io::sqlite {

namespace writer_health_test {

using namespace std::chrono_literals;

const store_error full{.code = store_errc::disk_full, .file = "f", .what = "full", .remedy = {}};
const writer_health::time_point start{1h};

TEST(writer_health, it_tells_when_failing_turns_on_and_off) {
  int changes = 0;
  writer_health health({}, [&] { ++changes; });
  health.failed(full, start);
  health.failed(full, start + 1s);
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(health.counts().failing_since, start);
  EXPECT_EQ(health.counts().last_error->what, "full");
  health.committed(3);
  health.committed(2);
  EXPECT_EQ(changes, 2);
  const auto counts = health.counts();
  EXPECT_FALSE(counts.failing_since || counts.last_error);
  EXPECT_EQ(counts.commits, 2U);
  EXPECT_EQ(counts.written, 5U);
  EXPECT_EQ(counts.retries, 2U);
}

TEST(writer_health, the_wait_doubles_up_to_the_last_and_begins_anew) {
  writer_health health({.first = 10ms, .last = 25ms}, {});
  EXPECT_TRUE(health.may_try(start));
  for (const auto wait : {10ms, 20ms, 25ms, 25ms}) {
    health.failed(full, start);
    EXPECT_FALSE(health.may_try(start + wait - 1ns));
    EXPECT_TRUE(health.may_try(start + wait));
  }
  health.committed(1);
  health.failed(full, start);
  EXPECT_EQ(health.next_try(), start + 10ms);
}

TEST(writer_health, a_try_at_once_does_not_wait) {
  writer_health health({}, {});
  health.failed(full, start);
  health.try_at_once(start);
  EXPECT_TRUE(health.may_try(start));
  EXPECT_TRUE(health.is_failing());
}

} // namespace writer_health_test

} // namespace godwit::io::sqlite
