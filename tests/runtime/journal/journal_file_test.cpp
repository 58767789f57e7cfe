#include <algorithm>
#include <csignal>
#include <fstream>
#include <random>

#include <sys/wait.h>

#include "io/sqlite/database.hpp"
#include "io/sqlite/fault_vfs.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace journal_file_test {

using io::sqlite::fault_kind;
using io::sqlite::fault_vfs;
using namespace godwit::runtime;

class journal_file_test : public ::testing::Test {
protected:
  ~journal_file_test() override { fault_vfs::instance().disarm(); }

  void fill(std::int64_t events) {
    auto journal = open_journal({.path = path});
    for (std::int64_t n = 1; n <= events; ++n)
      ASSERT_TRUE(journal->submit(event_write("a", n)));
  }
  void change(const std::string& sql) {
    auto db = io::sqlite::database::open(path, {});
    ASSERT_TRUE(db);
    ASSERT_TRUE(db->exec(sql)) << sql;
  }
  void write_file(const std::string& name, const std::string& content) {
    std::ofstream(name, std::ios::binary) << content;
  }

  scratch_folder folder;
  std::string path = folder.path("journal.db");
};

TEST_F(journal_file_test, an_empty_file_is_not_a_beginning) {
  write_file(path, "");
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::foreign);
  EXPECT_EQ(std::filesystem::file_size(path), 0U);
}

TEST_F(journal_file_test, a_file_of_something_else_is_foreign_and_stays_as_it_is) {
  write_file(path, std::string(8192, 'x'));
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::foreign);
  EXPECT_EQ(std::filesystem::file_size(path), 8192U);
}

TEST_F(journal_file_test, a_database_of_another_program_is_foreign) {
  auto db = io::sqlite::database::open(path, {.mode = io::sqlite::open_mode::create});
  ASSERT_TRUE(db && db->exec("CREATE TABLE t(x)"));
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::foreign);
}

TEST_F(journal_file_test, a_folder_in_its_place_is_foreign) {
  std::filesystem::create_directory(path);
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::foreign);
}

TEST_F(journal_file_test, a_log_without_its_file_is_not_a_beginning) {
  write_file(path + "-wal", "frames");
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::missing);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(journal_file_test, a_missing_journal_is_an_error_where_it_must_exist) {
  EXPECT_EQ(refused_open({.path = path, .create = false}).code, journal_errc::missing);
}

TEST_F(journal_file_test, what_a_crash_left_of_a_half_made_journal_is_made_anew) {
  write_file(path + ".new", "half");
  write_file(path + ".new-journal", "half");
  EXPECT_TRUE(open_journal({.path = path}));
  EXPECT_FALSE(std::filesystem::exists(path + ".new"));
}

TEST_F(journal_file_test, a_newer_journal_is_refused) {
  fill(1);
  change("PRAGMA user_version = 99");
  const auto error = refused_open({.path = path});
  EXPECT_EQ(error.code, journal_errc::newer);
  EXPECT_NE(error.what.find("99"), std::string::npos);
  EXPECT_EQ(journal_reader::open(path).error().code, journal_errc::newer);
}

TEST_F(journal_file_test, component_tables_move_to_their_newest_version_and_keep_their_rows) {
  {
    auto journal = open_journal({.path = path, .tables = {{"poi", {"CREATE TABLE poi(id)"}}}});
    auto write = event_write("a", 1);
    write.rows = {{"INSERT INTO poi VALUES (?)", {std::string("x")}}};
    ASSERT_TRUE(commit(*journal, std::move(write)));
  }
  auto journal = open_journal({.path = path,
                               .tables = {{"poi",
                                           {"CREATE TABLE poi(id)", "ALTER TABLE poi ADD seen; "
                                                                    "UPDATE poi SET seen = 3"}}}});
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal_reader::open(path)->database().query_integer("SELECT seen FROM poi WHERE id = 'x'").value(), 3);
}

TEST_F(journal_file_test, a_newer_component_table_is_refused_by_name_before_anything_moves) {
  { open_journal({.path = path, .tables = {{"poi", {"CREATE TABLE poi(id)", "ALTER TABLE poi ADD seen"}}}}); }
  const auto error =
      refused_open({.path = path, .tables = {{"other", {"CREATE TABLE other(x)"}}, {"poi", {"CREATE TABLE poi(id)"}}}});
  EXPECT_EQ(error.code, journal_errc::newer);
  EXPECT_NE(error.what.find("poi"), std::string::npos);
  EXPECT_EQ(
      journal_reader::open(path)->database().query_integer("SELECT count(*) FROM sqlite_schema WHERE name = 'other'"),
      0);
}

TEST_F(journal_file_test, a_migration_that_fails_leaves_the_old_version) {
  { open_journal({.path = path, .tables = {{"poi", {"CREATE TABLE poi(id)"}}}}); }
  const auto error = refused_open(
      {.path = path,
       .tables = {{"poi", {"CREATE TABLE poi(id)", "ALTER TABLE poi ADD seen; INSERT INTO nowhere VALUES (1)"}}}});
  EXPECT_EQ(error.code, journal_errc::io);
  EXPECT_NE(error.what.find("nowhere"), std::string::npos);
  EXPECT_TRUE(open_journal({.path = path, .tables = {{"poi", {"CREATE TABLE poi(id)", "ALTER TABLE poi ADD seen"}}}}));
}

TEST_F(journal_file_test, damaged_pages_are_refused) {
  fill(2'000);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  for (std::int64_t page = 4; page * 4096 < size; ++page) {
    file.seekp(page * 4096);
    file << std::string(64, '\xff');
  }
  file.close();
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::corrupt);
}

TEST_F(journal_file_test, a_truncated_file_is_refused) {
  fill(2'000);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_EQ(refused_open({.path = path}).code, journal_errc::corrupt);
}

// SQLite has no checksum over the database file: a flipped bit inside a text can go unseen. What must hold is that no
// damage is taken for a beginning and none brings the program down.
TEST_F(journal_file_test, any_flipped_bytes_end_in_an_error_or_in_whole_records) {
  fill(300);
  const auto size = std::filesystem::file_size(path);
  std::mt19937_64 random(1);
  int refused = 0;
  for (int round = 0; round < 60; ++round) {
    const auto copy = folder.path("copy_" + std::to_string(round) + ".db");
    std::filesystem::copy_file(path, copy);
    {
      std::fstream file(copy, std::ios::in | std::ios::out | std::ios::binary);
      for (int flip = 0; flip < 8; ++flip) {
        file.seekp(static_cast<std::streamoff>(random() % size));
        file.put(static_cast<char>(random()));
      }
    }
    auto opened = sqlite_journal::open({.path = copy});
    if (!opened) {
      ++refused;
      EXPECT_FALSE(opened.error().remedy.empty());
      continue;
    }
    const auto state = recover(**opened, "a");
    EXPECT_TRUE(!state || state->last_event > 0) << "round " << round << ": taken for a beginning";
    opened->reset();
    std::filesystem::remove(copy);
  }
  EXPECT_GT(refused, 5);
}

TEST_F(journal_file_test, a_gap_in_the_events_is_reported_as_damage) {
  fill(10);
  change("DELETE FROM actor_event WHERE number = 5");
  auto journal = open_journal({.path = path});
  const auto state = recover(*journal, "a");
  ASSERT_FALSE(state);
  EXPECT_EQ(state.error().code, journal_errc::corrupt);
}

TEST_F(journal_file_test, a_folder_that_can_not_be_made_is_named) {
  const auto error = refused_open({.path = "/proc/godwit/journal.db"}); // not even root makes folders in /proc
  EXPECT_EQ(error.code, journal_errc::read_only);
  EXPECT_NE((error.what + error.remedy).find("/proc/godwit"), std::string::npos);
}

TEST_F(journal_file_test, a_folder_that_can_not_be_written_is_an_error) {
  EXPECT_FALSE(sqlite_journal::open({.path = "/proc/journal.db"}));
}

TEST_F(journal_file_test, a_file_that_opens_for_reading_only_is_refused_for_writing) {
  fill(3);
  auto& vfs = fault_vfs::instance();
  vfs.set_read_only(true);
  EXPECT_EQ(refused_open({.path = path, .vfs = fault_vfs::name}).code, journal_errc::read_only);
  auto reader = journal_reader::open(path, fault_vfs::name);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ(reader->events("a")->size(), 3U);
}

TEST_F(journal_file_test, a_full_disk_at_the_start_is_named) {
  fill(3);
  fault_vfs::instance().arm({fault_kind::disk_full, 2, true});
  const auto error = refused_open({.path = path, .vfs = fault_vfs::name});
  EXPECT_EQ(error.code, journal_errc::disk_full);
  EXPECT_NE(error.remedy.find("Free space"), std::string::npos);
  fault_vfs::instance().disarm();
  EXPECT_EQ(recover(*open_journal({.path = path}), "a")->last_event, 3);
}

TEST_F(journal_file_test, a_second_writer_is_told_who_the_first_is) {
  auto first = open_journal({.path = path});
  const auto error = refused_open({.path = path});
  EXPECT_EQ(error.code, journal_errc::locked);
  EXPECT_NE(error.what.find(std::to_string(::getpid())), std::string::npos) << error.message();
  first->close();
  EXPECT_TRUE(open_journal({.path = path}));
}

} // namespace journal_file_test
} // namespace godwit::tests
