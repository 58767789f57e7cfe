#include "io/sqlite/backup.hpp"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace godwit::io::sqlite {
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
