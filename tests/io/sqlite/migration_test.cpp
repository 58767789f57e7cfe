#include "io/sqlite/migration.hpp"

#include <gtest/gtest.h>

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
