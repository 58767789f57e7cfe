#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "io/sqlite/database.hpp"
#include "io/sqlite/statement_cache.hpp"

namespace godwit::io::sqlite {

namespace database_test {

class database_test : public ::testing::Test {
protected:
  database_test() : db(std::move(*database::open(":memory:", {.mode = open_mode::create}))) {
    EXPECT_TRUE(db.exec("CREATE TABLE t(a, b)"));
  }

  database db;
};

TEST_F(database_test, values_of_every_type_come_back) {
  auto insert = db.prepare("INSERT INTO t VALUES (?, ?)");
  ASSERT_TRUE(insert);
  ASSERT_TRUE(insert->with(std::int64_t{-5}, std::string("x'y")).run());
  ASSERT_TRUE(insert->with(2.5, nullptr).run());
  EXPECT_EQ(db.query_integer("SELECT a FROM t WHERE b = 'x''y'").value(), -5);
  EXPECT_EQ(db.query_text("SELECT typeof(a) || typeof(b) FROM t WHERE b IS NULL").value(), "realnull");
}

TEST_F(database_test, an_error_carries_the_statement) {
  const auto failed = db.exec("INSERT INTO nowhere VALUES (1)");
  ASSERT_FALSE(failed);
  EXPECT_TRUE(is_programming_error(failed.error()));
  EXPECT_NE(failed.error().message.find("nowhere"), std::string::npos);
}

TEST_F(database_test, an_error_of_binding_comes_with_the_step) {
  auto insert = db.prepare("INSERT INTO t VALUES (?, 1)");
  ASSERT_TRUE(insert);
  const auto failed = insert->with(std::int64_t{1}, std::int64_t{2}).run();
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, SQLITE_RANGE);
  EXPECT_TRUE(insert->with(std::int64_t{1}).run()) << "the next use is clean";
}

TEST_F(database_test, two_statements_in_one_text_are_not_prepared) {
  EXPECT_FALSE(db.prepare("SELECT 1; SELECT 2"));
  EXPECT_FALSE(db.prepare(""));
  EXPECT_TRUE(db.prepare("SELECT 1; "));
}

TEST_F(database_test, a_transaction_that_is_not_committed_never_happened) {
  {
    auto change = transaction::begin(db);
    ASSERT_TRUE(change);
    ASSERT_TRUE(db.exec("INSERT INTO t VALUES (1, 1)"));
  }
  EXPECT_FALSE(db.in_transaction());
  EXPECT_EQ(db.query_integer("SELECT count(*) FROM t").value(), 0);
  auto change = transaction::begin(db);
  ASSERT_TRUE(db.exec("INSERT INTO t VALUES (1, 1)"));
  EXPECT_TRUE(change->commit());
  EXPECT_EQ(db.query_integer("SELECT count(*) FROM t").value(), 1);
}

TEST_F(database_test, the_statement_cache_is_bounded_and_keeps_what_is_used) {
  statement_cache cache(db, 3);
  auto* kept = *cache.get("SELECT 0");
  for (int i = 1; i <= 10; ++i) {
    ASSERT_TRUE(cache.get("SELECT " + std::to_string(i)));
    ASSERT_EQ(*cache.get("SELECT 0"), kept);
  }
  EXPECT_EQ(cache.size(), 3U);
  EXPECT_FALSE(cache.get("SELECT nothing"));
}

TEST_F(database_test, a_file_name_carries_no_options) {
  EXPECT_FALSE(database::open("no_such_file.db?mode=memory", {.mode = open_mode::read_only}));
}

} // namespace database_test

namespace backup_test {

namespace fs = std::filesystem;

class backup : public testing::Test {
protected:
  backup() {
    std::string name = (fs::temp_directory_path() / "godwit-backup-XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  ~backup() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string at(const char* name) const { return (folder_ / name).string(); }

private:
  fs::path folder_;
};

TEST_F(backup, the_copy_has_what_was_committed_and_not_what_a_writer_is_about_to) {
  auto writer = database::open(at("a.db"), {.mode = open_mode::create});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->exec("PRAGMA journal_mode = WAL; CREATE TABLE t(x); INSERT INTO t VALUES (1), (2)"));
  ASSERT_TRUE(writer->exec("BEGIN IMMEDIATE; INSERT INTO t VALUES (3)"));
  auto reader = database::open(at("a.db"), {.mode = open_mode::read_only});
  ASSERT_TRUE(reader);
  ASSERT_TRUE(back_up(*reader, at("b.db")));
  EXPECT_TRUE(writer->exec("COMMIT"));
  EXPECT_FALSE(fs::exists(at("b.db-wal")));
  auto copy = database::open(at("b.db"), {.mode = open_mode::immutable});
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->query_integer("SELECT count(*) FROM t").value(), 2);
  EXPECT_EQ(copy->query_text("PRAGMA integrity_check").value(), "ok");
}

TEST_F(backup, a_place_that_takes_no_file_is_an_error) {
  auto from = database::open(at("a.db"), {.mode = open_mode::create});
  ASSERT_TRUE(from);
  EXPECT_FALSE(back_up(*from, at("none/b.db")));
}

} // namespace backup_test

} // namespace godwit::io::sqlite
