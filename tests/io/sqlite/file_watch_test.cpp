#include "io/sqlite/file_watch.hpp"

#include <filesystem>

#include "tests/io/sqlite/store_fixture.hpp"

namespace godwit::tests {
namespace file_watch_test {

namespace fs = std::filesystem;
using io::sqlite::file_watch;

class file_watch_test : public store_test {
protected:
  io::sqlite::store_file file = open();
  file_watch watch{path(), file.lock.database_descriptor()};

  void SetUp() override {
    ASSERT_TRUE(file.db.exec("INSERT INTO note(text) VALUES ('a')"));
    ASSERT_FALSE(watch.look());
  }
  std::string trouble() {
    const auto found = watch.look();
    return found ? (found->is_whole ? "whole: " : "") + found->what : "";
  }
};

TEST_F(file_watch_test, a_database_that_grows_and_is_checkpointed_is_well) {
  for (int i = 0; i < 300; ++i)
    ASSERT_TRUE(file.db.exec("INSERT INTO note(text) VALUES (hex(randomblob(500)))"));
  EXPECT_EQ(trouble(), "");
  ASSERT_TRUE(file.db.exec("PRAGMA wal_checkpoint(PASSIVE)"));
  EXPECT_EQ(trouble(), "");
}

TEST_F(file_watch_test, a_deleted_and_a_replaced_file_are_noticed_and_what_is_open_is_whole) {
  fs::rename(path(), path() + ".away");
  EXPECT_EQ(trouble(), "whole: the file was deleted or moved away");
  fs::copy_file(path() + ".away", path());
  EXPECT_EQ(trouble(), "whole: another file lies in its place");
}

TEST_F(file_watch_test, a_file_that_was_cut_is_noticed) {
  fs::resize_file(path(), fs::file_size(path()) - 1);
  EXPECT_NE(trouble().find("the file was cut from"), std::string::npos);
}

TEST_F(file_watch_test, a_log_and_its_index_that_were_cut_deleted_or_replaced_are_noticed) {
  fs::resize_file(path() + "-wal", 100);
  EXPECT_NE(trouble().find("its log was cut from"), std::string::npos);
  fs::remove(path() + "-wal");
  EXPECT_NE(trouble().find("its log was deleted"), std::string::npos);
  file_watch again(path(), file.lock.database_descriptor());
  ASSERT_FALSE(again.look());
  fs::rename(path() + "-shm", path() + "-gone");
  EXPECT_NE(again.look()->what.find("the index of its log was deleted"), std::string::npos);
  fs::rename(path() + "-gone", path() + "-shm");
  file.db.leave_log_at_close();
}

} // namespace file_watch_test
} // namespace godwit::tests
