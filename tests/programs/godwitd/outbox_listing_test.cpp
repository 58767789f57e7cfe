#include <future>

#include <gtest/gtest.h>

#include "programs/godwitd/outbox_listing.hpp"
#include "runtime/journal/sqlite_journal.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace outbox_listing_test {

using namespace godwit;
using namespace godwit::daemon;
using runtime::delivery_state;

constexpr std::int64_t second_ns = 1'000'000'000;

runtime::outbox_row row(const std::string& key, std::int64_t created_s, delivery_state state) {
  return {key,
          "progress",
          R"({"mission_id": "7d1c"})",
          created_s * second_ns,
          state,
          3,
          "no answer",
          160 * second_ns,
          110 * second_ns};
}

// The writer stays open: it is listed beside a running daemon.
struct written {
  explicit written(const std::string& path) : journal(runtime::sqlite_journal::open({.path = path}).value()) {
    runtime::journal_write write;
    write.actor = "mission_client";
    write.incarnation = 1;
    write.outbox = {row("b", 100, delivery_state::pending), row("a", 90, delivery_state::orphaned),
                    row("c", 80, delivery_state::delivered)};
    std::promise<bool> done;
    write.done = [&done](const runtime::commit_result& result) { done.set_value(result.has_value()); };
    EXPECT_TRUE(journal->submit(std::move(write)));
    EXPECT_TRUE(done.get_future().get());
  }
  std::unique_ptr<runtime::sqlite_journal> journal;
};

TEST(outbox_listing, what_is_owed_is_listed_beside_its_writer_and_the_oldest_first) {
  const test::scratch folder;
  const written journal(folder.file("godwit.db"));
  const auto listing = read_outbox(folder.file("godwit.db"));
  ASSERT_TRUE(listing) << listing.error();
  ASSERT_EQ(listing->rows.size(), 2U);
  EXPECT_EQ(listing->rows[0].row.idempotency_key, "a");
  EXPECT_EQ(listing->rows[1].row.idempotency_key, "b");
  EXPECT_EQ(listing->rows[1].mission_id, "7d1c");
  EXPECT_EQ(listing->delivered, 1);
  EXPECT_FALSE(listing->is_cut);
}

TEST(outbox_listing, people_read_when_it_is_tried_again_and_why_it_was_not_delivered) {
  const outbox_listing listing{{{row("b", 100, delivery_state::pending), "7d1c"}}, 4, false};
  EXPECT_EQ(table_of(listing, 150 * second_ns),
            "b  pending  progress, mission 7d1c, 50 s old, tried 3 times, next try in 10 s\n"
            "    no answer\n"
            "1 pending; 4 delivered and still kept\n");
  EXPECT_EQ(table_of({}, 0), "nothing is pending; 0 delivered and still kept\n");
}

TEST(outbox_listing, programs_read_the_same_as_json) {
  const outbox_listing listing{
      {{row("b", 100, delivery_state::pending), "7d1c"}, {row("a", 90, delivery_state::expired), ""}}, 0, false};
  const auto shown = json_of(listing, 150 * second_ns);
  EXPECT_EQ(shown.at("rows").at(0).at("next_try"), "1970-01-01T00:02:40Z");
  EXPECT_EQ(shown.at("rows").at(0).at("age_s"), 50);
  EXPECT_EQ(shown.at("rows").at(1).at("state"), "expired");
  EXPECT_TRUE(shown.at("rows").at(1).at("next_try").is_null());
  EXPECT_TRUE(shown.at("rows").at(1).at("mission_id").is_null());
}

TEST(outbox_listing, a_journal_that_is_not_there_is_named) {
  const test::scratch folder;
  const auto listing = read_outbox(folder.file("none.db"));
  ASSERT_FALSE(listing);
  EXPECT_NE(listing.error().find("none.db"), std::string::npos);
}

} // namespace outbox_listing_test

namespace durations_test {

using godwit::daemon::duration_text;

constexpr std::int64_t second_ns = 1'000'000'000;

TEST(durations, are_told_in_the_unit_that_people_would_use) {
  EXPECT_EQ(duration_text(-5), "0 s");
  EXPECT_EQ(duration_text(450'000'000), "0.4 s");
  EXPECT_EQ(duration_text(12 * second_ns), "12 s");
  EXPECT_EQ(duration_text(119 * second_ns), "119 s");
  EXPECT_EQ(duration_text(180 * second_ns), "3 min");
  EXPECT_EQ(duration_text(5 * 3600 * second_ns + 1200 * second_ns), "5 h 20 min");
  EXPECT_EQ(duration_text(3600 * second_ns), "1 h");
  EXPECT_EQ(duration_text(72 * 3600 * second_ns), "3 days");
}

} // namespace durations_test
