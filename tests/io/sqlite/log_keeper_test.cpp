#include "io/sqlite/log_keeper.hpp"

#include <optional>

#include "tests/io/sqlite/store_fixture.hpp"

namespace godwit::tests {
namespace log_keeper_test {

using namespace io::sqlite;

constexpr log_bounds bounds{.long_bytes = 4 * 1024 * 1024, .very_long_bytes = 16 * 1024 * 1024};

// A database with a log that is as long as wanted.
class log_keeper_test : public store_test {
protected:
  log_keeper_test() : file(open()) {
    EXPECT_TRUE(file.db.exec("CREATE TABLE filling(bytes BLOB)"));
    keeper.emplace(file.db, bounds);
  }

  void write(std::int64_t bytes) {
    ASSERT_TRUE(file.db.exec("INSERT INTO filling VALUES (zeroblob(" + std::to_string(bytes) + "))"));
  }
  [[nodiscard]] std::int64_t database_bytes() const {
    return static_cast<std::int64_t>(std::filesystem::file_size(path()));
  }

  store_file file;
  std::optional<log_keeper> keeper;
};

TEST_F(log_keeper_test, a_short_log_is_left_alone) {
  write(bounds.long_bytes / 2);
  keeper->look_after(false);
  EXPECT_LT(database_bytes(), bounds.long_bytes / 2);
}

TEST_F(log_keeper_test, a_long_one_is_moved_when_nobody_waits) {
  write(bounds.long_bytes);
  keeper->look_after(true);
  EXPECT_LT(database_bytes(), bounds.long_bytes);
  keeper->look_after(false);
  EXPECT_GE(database_bytes(), bounds.long_bytes);
}

TEST_F(log_keeper_test, a_very_long_one_is_moved_all_the_same) {
  write(bounds.very_long_bytes);
  keeper->look_after(true);
  EXPECT_GE(database_bytes(), bounds.very_long_bytes);
}

TEST_F(log_keeper_test, closing_moves_everything) {
  write(1'000'000);
  keeper->close();
  EXPECT_GE(database_bytes(), 1'000'000);
}

} // namespace log_keeper_test
} // namespace godwit::tests
