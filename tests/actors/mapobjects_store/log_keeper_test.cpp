#include "actors/mapobjects_store/log_keeper.hpp"

#include <filesystem>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace {

using namespace godwit::tests;

// A database with a log that is as long as wanted.
class log_keeper_test : public ::testing::Test {
protected:
  log_keeper_test() {
    map_file_options options;
    options.path = folder.file();
    EXPECT_TRUE(make_folder_of(options.path));
    db.emplace(std::move(*open_map_for_writing(options)));
    EXPECT_TRUE(db->exec("CREATE TABLE filling(bytes BLOB)"));
    keeper.emplace(*db);
  }
  ~log_keeper_test() override { keeper.reset(); }

  void write(std::int64_t bytes) {
    ASSERT_TRUE(db->exec("INSERT INTO filling VALUES (zeroblob(" + std::to_string(bytes) + "))"));
  }
  [[nodiscard]] std::uintmax_t database_bytes() const { return std::filesystem::file_size(folder.file()); }

  scratch_folder folder;
  std::optional<io::sqlite::database> db;
  std::optional<log_keeper> keeper;
};

TEST_F(log_keeper_test, a_short_log_is_left_alone) {
  write(log_keeper::long_bytes / 2);
  keeper->look_after(false);
  EXPECT_LT(database_bytes(), static_cast<std::uintmax_t>(log_keeper::long_bytes / 2));
}

TEST_F(log_keeper_test, a_long_one_is_moved_when_nobody_waits) {
  write(log_keeper::long_bytes);
  keeper->look_after(true);
  EXPECT_LT(database_bytes(), static_cast<std::uintmax_t>(log_keeper::long_bytes));
  keeper->look_after(false);
  EXPECT_GE(database_bytes(), static_cast<std::uintmax_t>(log_keeper::long_bytes));
}

TEST_F(log_keeper_test, a_very_long_one_is_moved_all_the_same) {
  write(log_keeper::very_long_bytes);
  keeper->look_after(true);
  EXPECT_GE(database_bytes(), static_cast<std::uintmax_t>(log_keeper::very_long_bytes));
}

TEST_F(log_keeper_test, closing_moves_everything) {
  write(1'000'000);
  keeper->close();
  EXPECT_GE(database_bytes(), 1'000'000U);
}

} // namespace
} // namespace godwit::mapobjects_store
