// A file of a made-up kind in a folder of its own. Thread: the test's.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "io/sqlite/fault_vfs.hpp"
#include "io/sqlite/store_file.hpp"

namespace godwit::tests {

using io::sqlite::fault_vfs;

inline const io::sqlite::store_format& note_format() {
  static const io::sqlite::store_format format{
      .kind = {.name = "notebook", .when_corrupt = "Write it again"},
      .application_id = 0x6e6f7465,
      .migrations = {"CREATE TABLE note(text TEXT UNIQUE NOT NULL)", "ALTER TABLE note ADD at INTEGER"},
      .read_version = "PRAGMA user_version",
      .set_version = "PRAGMA user_version = ",
      .settings = {}};
  return format;
}

class store_test : public ::testing::Test {
protected:
  store_test() {
    static std::atomic<int> made{0};
    folder_ = std::filesystem::current_path() /
              ("notes_" + std::to_string(::getpid()) + "_" + std::to_string(made.fetch_add(1)));
    fault_vfs::instance().disarm();
  }
  ~store_test() override {
    fault_vfs::instance().disarm();
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  [[nodiscard]] std::string path() const { return (folder_ / "notes.db").string(); }
  [[nodiscard]] io::sqlite::store_options options() const {
    return {.path = path(), .vfs = fault_vfs::name, .inspect = {}};
  }
  [[nodiscard]] io::sqlite::store_file open() const {
    auto opened = io::sqlite::open_for_writing(note_format(), options());
    EXPECT_TRUE(opened.has_value()) << (opened ? "" : opened.error().what);
    return std::move(*opened);
  }
  [[nodiscard]] std::int64_t rows() const {
    auto db = io::sqlite::open_for_reading(note_format(), path(), {});
    return db ? db->query_integer("SELECT count(*) FROM note").value_or(-1) : -1;
  }

private:
  std::filesystem::path folder_;
};

} // namespace godwit::tests
