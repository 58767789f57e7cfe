// The rows of the audit in a journal: which are kept, and how they are read.
#include "actors/operator_bridge/audit_table.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "tests/support/audit_rows.hpp"

namespace godwit::operator_bridge {
namespace audit_table_test {

using operators::role;

class audit_table_of : public ::testing::Test {
protected:
  void put(audit_row row) {
    runtime::journal_write write;
    put_row(write, row, bounds_);
    for (const auto& each : write.rows)
      table_.run(each);
  }
  void add(const std::string& name, const std::string& session, const std::string& outcome) {
    put({.number = ++last_,
         .at_ns = static_cast<std::int64_t>(last_),
         .who = {name, role::operator_, session},
         .what = "start",
         .outcome = outcome});
  }
  void add(int rows, const std::string& name, const std::string& session, const std::string& outcome) {
    ASSERT_TRUE(table_.db.exec("BEGIN"));
    for (int i = 0; i < rows; ++i)
      add(name, session, outcome);
    ASSERT_TRUE(table_.db.exec("COMMIT"));
  }
  std::int64_t count(const std::string& where) {
    return table_.db.query_integer("SELECT count(*) FROM audit WHERE " + where).value_or(-1);
  }
  audit_page read(std::uint64_t before, std::uint32_t most) { return table_.read({before, most}); }

  audit_bounds bounds_{.acts = 600, .refusals = 350, .strangers = 50, .trimmed_each = 16};
  std::uint64_t last_ = 0;
  audit_support::audit_rows table_;
};

TEST_F(audit_table_of, a_row_is_read_as_it_was_written) {
  const audit_row row{3, 17, {"anna", role::engineer, "s7"}, "start", "c1", "refused", "no; really", 4};
  put(row);
  EXPECT_EQ(read(0, 10).rows, (std::vector<audit_row>{row}));
  auto again = row;
  again.count = 9;
  again.at_ns = 18;
  put(again);
  EXPECT_EQ(read(0, 10).rows, (std::vector<audit_row>{again})) << "one row that grows";
}

TEST_F(audit_table_of, are_read_page_by_page_from_the_newest_back) {
  add(5, "anna", "s1", "taken");
  const auto first = read(0, 2);
  ASSERT_EQ(first.rows.size(), 2U);
  EXPECT_EQ(first.rows.back().number, 5U);
  EXPECT_TRUE(first.has_older);
  const auto second = read(first.rows.front().number, 2);
  EXPECT_EQ(second.rows.back().number, 3U);
  const auto last = read(second.rows.front().number, 2);
  EXPECT_EQ(last.rows.size(), 1U);
  EXPECT_FALSE(last.has_older);
  EXPECT_TRUE(read(1, 2).rows.empty());
}

TEST_F(audit_table_of, what_was_obeyed_is_never_displaced_by_what_was_refused_or_said_by_strangers) {
  add(300, "anna", "s1", "taken");
  add(500, "eve", "s2", "wrong_role");
  add(100, "mallory", {}, "no_session");
  EXPECT_EQ(count("name = 'anna'"), 300);
  EXPECT_LE(count("name = 'eve'"), bounds_.refusals + static_cast<std::int64_t>(bounds_.trimmed_each));
  EXPECT_GE(count("name = 'eve'"), bounds_.refusals);
  EXPECT_LE(count("name = 'mallory'"), bounds_.strangers + static_cast<std::int64_t>(bounds_.trimmed_each));
  EXPECT_EQ(read(0, 1).rows.front().number, last_) << "the newest are kept";
}

TEST_F(audit_table_of, who_has_most_loses_the_oldest_and_the_refusals_of_others_stay) {
  add(100, "anna", "s1", "refused");
  add(50, "bob", "s3", "late");
  add(500, "eve", "s2", "wrong_role");
  EXPECT_EQ(count("name = 'anna'"), 100);
  EXPECT_EQ(count("name = 'bob'"), 50);
}

TEST_F(audit_table_of, strangers_are_one_share_whatever_names_they_give) {
  add(20, "first", {}, "no_session");
  for (int i = 0; i < 20; ++i)
    add(10, "m" + std::to_string(i), {}, "no_session");
  EXPECT_EQ(count("name = 'first'"), 0) << "the oldest";
}

TEST_F(audit_table_of, a_full_table_is_trimmed) {
  bounds_ = {};
  ASSERT_TRUE(table_.db.exec(
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 60100) INSERT INTO audit SELECT i, 0, "
      "'p' || (i % 20), i, 'p' || (i % 20), 'operator', 's1', 'start', '', 'taken', '', 1 FROM n"));
  last_ = 60'100;
  last_ += bounds_.trimmed_each - last_ % bounds_.trimmed_each - 1;
  const auto began = std::chrono::steady_clock::now();
  add("anna", "s1", "taken");
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - began;
  std::printf("trimmed in %.0f ms\n", took.count());
  EXPECT_LT(took.count(), 10'000) << "also on a busy machine";
  EXPECT_EQ(count("kind = 0"), bounds_.acts);
  EXPECT_EQ(count("name = 'anna'"), 1);
}

} // namespace audit_table_test
} // namespace godwit::operator_bridge
