#include <fstream>

#include <gtest/gtest.h>

#include "io/sqlite/store_file.hpp"
#include "tests/io/sqlite/store_fixture.hpp"

namespace godwit::tests {

namespace store_file_test {

using namespace io::sqlite;

class store_file_test : public store_test {
protected:
  void change(const std::string& sql) const {
    auto db = database::open(path(), {});
    ASSERT_TRUE(db && db->exec(sql)) << sql;
  }
  [[nodiscard]] store_error refusal(const store_options& wanted) const {
    const auto opened = open_for_writing(note_format(), wanted);
    EXPECT_FALSE(opened.has_value());
    if (opened)
      return {};
    EXPECT_EQ(opened.error().file, path());
    EXPECT_FALSE(opened.error().what.empty() || opened.error().remedy.empty());
    return opened.error();
  }
};

TEST_F(store_file_test, a_new_one_is_whole_synced_and_only_for_its_user) {
  auto made = open();
  EXPECT_EQ(made.db.query_text("PRAGMA journal_mode").value(), "wal");
  EXPECT_EQ(made.db.query_integer("PRAGMA synchronous").value(), 2);
  EXPECT_EQ(made.db.query_integer("PRAGMA user_version").value(), 2);
  EXPECT_FALSE(std::filesystem::exists(path() + ".new"));
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(path()).permissions(), perms::owner_read | perms::owner_write);
}

TEST_F(store_file_test, an_older_one_moves_to_the_newest_version_and_keeps_its_rows) {
  auto old = note_format();
  old.migrations.pop_back();
  ASSERT_TRUE(open_for_writing(old, options()).and_then([](auto file) -> store_result<void> {
    EXPECT_TRUE(file.db.exec("INSERT INTO note VALUES ('kept')"));
    return {};
  }));
  EXPECT_EQ(open().db.query_text("SELECT text FROM note WHERE at IS NULL").value(), "kept");
}

TEST_F(store_file_test, a_newer_one_is_refused_with_both_versions) {
  { static_cast<void>(open()); }
  change("PRAGMA user_version = 9");
  const auto error = refusal(options());
  EXPECT_EQ(error.code, store_errc::newer);
  EXPECT_NE(error.what.find("version 9"), std::string::npos) << error.what;
  EXPECT_EQ(open_for_reading(note_format(), path(), {}).error().code, store_errc::newer);
}

TEST_F(store_file_test, what_is_not_ours_is_refused_and_stays) {
  { static_cast<void>(open()); }
  change("PRAGMA application_id = 7");
  EXPECT_EQ(refusal(options()).code, store_errc::foreign);
  change("PRAGMA application_id = " + std::to_string(note_format().application_id));
  EXPECT_EQ(open().db.query_integer("PRAGMA user_version").value(), 2);
}

TEST_F(store_file_test, one_without_a_version_is_damaged) {
  { static_cast<void>(open()); }
  auto asking_a_table = note_format();
  asking_a_table.read_version = "SELECT version FROM lost_table";
  EXPECT_EQ(open_for_writing(asking_a_table, options()).error().code, store_errc::corrupt);
}

TEST_F(store_file_test, an_empty_file_or_a_log_alone_is_not_a_beginning) {
  { static_cast<void>(open()); }
  std::filesystem::remove(path());
  std::ofstream(path() + "-wal") << "frames";
  EXPECT_EQ(refusal(options()).code, store_errc::missing);
  std::filesystem::remove(path() + "-wal");
  std::ofstream(path()) << "";
  EXPECT_EQ(refusal(options()).code, store_errc::foreign);
}

TEST_F(store_file_test, a_missing_one_is_made_only_when_that_is_wanted) {
  auto wanted = options();
  wanted.create = false;
  EXPECT_EQ(refusal(wanted).code, store_errc::missing);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(store_file_test, the_callers_check_comes_before_anything_moves) {
  auto old = note_format();
  old.migrations.pop_back();
  { static_cast<void>(open_for_writing(old, options())); }
  auto wanted = options();
  wanted.inspect = [this](database&) -> store_result<void> {
    return tl::unexpected(store_error{store_errc::newer, path(), "no", "none"});
  };
  EXPECT_EQ(refusal(wanted).what, "no");
  EXPECT_EQ(open_for_reading(old, path(), {})->query_integer("PRAGMA user_version").value(), 1);
}

TEST_F(store_file_test, each_fault_while_it_is_made_leaves_nothing_or_a_whole_file) {
  { static_cast<void>(open()); }
  const auto operations = fault_vfs::instance().operations();
  ASSERT_GT(operations, 5);
  for (std::int64_t at = 1; at <= operations; ++at) {
    for (const auto* suffix : {"", "-wal", "-shm"})
      std::filesystem::remove(path() + suffix);
    fault_vfs::instance().arm({fault_kind::disk_full, at, true});
    static_cast<void>(open_for_writing(note_format(), options()));
    fault_vfs::instance().disarm();
    EXPECT_EQ(open().db.query_integer("PRAGMA user_version").value(), 2) << "operation " << at;
  }
}

} // namespace store_file_test

} // namespace godwit::tests

namespace godwit::io::sqlite {

namespace migration_test {

const std::vector<std::string> steps{"CREATE TABLE t(a)", "ALTER TABLE t ADD b; INSERT INTO t VALUES (1, 2)"};

TEST(migration, only_the_steps_above_the_version_run) {
  auto db = database::open(":memory:", {.mode = open_mode::create});
  ASSERT_TRUE(db && db->exec("CREATE TABLE t(a)"));
  ASSERT_TRUE(run_migrations(*db, steps, 1, "PRAGMA user_version = 2"));
  EXPECT_EQ(db->query_integer("SELECT b FROM t").value(), 2);
  EXPECT_EQ(db->query_integer("PRAGMA user_version").value(), 2);
}

TEST(migration, one_that_fails_leaves_everything_as_it_was) {
  auto db = database::open(":memory:", {.mode = open_mode::create});
  ASSERT_TRUE(db);
  EXPECT_FALSE(run_migrations(*db, {steps[0], "INSERT INTO nowhere VALUES (1)"}, 0, "PRAGMA user_version = 2"));
  EXPECT_EQ(db->query_integer("SELECT count(*) FROM sqlite_schema").value(), 0);
  EXPECT_EQ(db->query_integer("PRAGMA user_version").value(), 0);
}

} // namespace migration_test

} // namespace godwit::io::sqlite

namespace godwit::tests {

namespace lock_file_test {

using namespace io::sqlite;
using lock_file_test = store_test;

TEST_F(lock_file_test, one_holds_it_and_the_other_hears_who) {
  const auto first = open();
  const auto second = lock_file::acquire(note_format().kind, path());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, store_errc::locked);
  EXPECT_NE(second.error().what.find(std::to_string(::getpid())), std::string::npos) << second.error().what;
}

TEST_F(lock_file_test, it_is_given_back_at_the_end_and_the_file_stays) {
  { const auto first = open(); }
  EXPECT_TRUE(std::filesystem::exists(path() + ".lock"));
  EXPECT_TRUE(lock_file::acquire(note_format().kind, path()));
}

TEST_F(lock_file_test, a_symbolic_link_and_a_removed_lock_file_let_nobody_else_in) {
  const auto first = open();
  const auto link = path() + ".link";
  std::filesystem::create_symlink(path(), link);
  auto wanted = options();
  wanted.path = link;
  const auto second = open_for_writing(note_format(), wanted);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, store_errc::locked);
  std::filesystem::remove(path() + ".lock");
  const auto third = open_for_writing(note_format(), options());
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, store_errc::locked);
}

TEST_F(lock_file_test, a_file_with_two_names_is_refused_under_both) {
  { const auto first = open(); }
  const auto link = path() + ".link";
  std::filesystem::create_hard_link(path(), link);
  for (const auto& each : {path(), link}) {
    auto wanted = options();
    wanted.path = each;
    const auto refused = open_for_writing(note_format(), wanted);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("2 names"), std::string::npos) << refused.error().what;
  }
}

TEST_F(lock_file_test, a_folder_that_is_not_there_is_an_error) {
  const auto refused = lock_file::acquire(note_format().kind, path());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find(path() + ".lock"), std::string::npos) << refused.error().what;
}

} // namespace lock_file_test

} // namespace godwit::tests
