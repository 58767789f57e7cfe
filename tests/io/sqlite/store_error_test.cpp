#include "io/sqlite/store_error.hpp"

#include <cerrno>

#include <gtest/gtest.h>
#include <sqlite3.h>

namespace godwit::io::sqlite {
namespace store_error_test {

const store_kind kind{.name = "notebook", .when_corrupt = "Write it again"};

store_error of_code(int code, int number = 0) {
  return describe({.code = code, .extended = code, .system_errno = number, .message = "text"}, kind, "f", "testing");
}

TEST(store_error, each_names_the_file_the_detail_and_a_remedy) {
  for (const int code :
       {SQLITE_FULL, SQLITE_CORRUPT, SQLITE_NOTADB, SQLITE_READONLY, SQLITE_IOERR, SQLITE_BUSY, SQLITE_CONSTRAINT}) {
    const auto error = of_code(code);
    EXPECT_EQ(error.file, "f");
    EXPECT_NE(error.what.find("(text, while testing)"), std::string::npos) << error.what;
    EXPECT_FALSE(error.remedy.empty());
  }
  EXPECT_EQ(of_code(SQLITE_CORRUPT).remedy, kind.when_corrupt);
}

TEST(store_error, what_the_disk_refuses_may_pass_and_damage_and_mistakes_may_not) {
  for (const int code : {SQLITE_FULL, SQLITE_READONLY, SQLITE_IOERR, SQLITE_BUSY, SQLITE_CANTOPEN, SQLITE_NOMEM})
    EXPECT_TRUE(may_pass(of_code(code).code)) << code;
  for (const int code : {SQLITE_CORRUPT, SQLITE_NOTADB, SQLITE_CONSTRAINT, SQLITE_ERROR, SQLITE_TOOBIG})
    EXPECT_FALSE(may_pass(of_code(code).code)) << code;
}

TEST(store_error, the_number_of_the_system_tells_what_an_io_error_means) {
  EXPECT_EQ(of_code(SQLITE_IOERR, ENOSPC).code, store_errc::disk_full);
  EXPECT_EQ(of_code(SQLITE_CANTOPEN, EACCES).code, store_errc::read_only);
  EXPECT_EQ(system_error(kind, "f", EROFS, "testing").code, store_errc::read_only);
  EXPECT_EQ(of_code(SQLITE_IOERR, EIO).code, store_errc::io);
}

} // namespace store_error_test
} // namespace godwit::io::sqlite
