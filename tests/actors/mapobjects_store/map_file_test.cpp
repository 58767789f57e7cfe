#include "actors/mapobjects_store/map_file.hpp"

#include <fstream>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_file_test {

using namespace godwit::tests;

class map_file : public tests::map_test {
protected:
  map_errc refusal() {
    close();
    const auto opened = map_store::open({.file = {.path = folder.file()}, .rules = {}});
    EXPECT_FALSE(opened.has_value());
    EXPECT_NE(opened.error().message().find(opened ? "" : "."), std::string::npos);
    return opened ? map_errc::internal : opened.error().code;
  }
  void execute(const std::string& text) {
    close();
    auto db = io::sqlite::database::open(folder.file(), {.mode = io::sqlite::open_mode::read_write});
    ASSERT_TRUE(db && db->exec(text));
  }
};

TEST_F(map_file, a_person_can_read_its_tables) {
  record(seen(1, place(0)));
  EXPECT_EQ(count("seen_object WHERE class_group = 'vehicle' AND latitude_deg > 47"), 1);
  EXPECT_EQ(count("observation WHERE kind = 'new' AND delivery = 'pending'"), 1);
  EXPECT_EQ(count("schema_version WHERE version = " + std::to_string(map_format().migrations.size())), 1);
}

TEST_F(map_file, only_one_process_writes_it) {
  const auto second = map_store::open({.file = {.path = folder.file()}, .rules = {}});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, map_errc::locked);
}

TEST_F(map_file, one_of_a_later_version_is_refused_and_stays) {
  execute("UPDATE schema_version SET version = version + 1");
  EXPECT_EQ(refusal(), map_errc::newer);
}

TEST_F(map_file, one_of_a_later_version_is_refused_wherever_that_keeps_its_number) {
  execute("PRAGMA user_version = 1000000");
  EXPECT_EQ(refusal(), map_errc::newer);
}

TEST_F(map_file, a_database_of_another_program_is_refused_and_stays) {
  execute("PRAGMA application_id = 7");
  EXPECT_EQ(refusal(), map_errc::foreign);
}

TEST_F(map_file, an_empty_file_is_not_taken_for_a_beginning) {
  close();
  std::filesystem::resize_file(folder.file(), 0);
  EXPECT_EQ(refusal(), map_errc::foreign);
}

TEST_F(map_file, what_is_not_a_database_is_refused) {
  close();
  std::ofstream(folder.file(), std::ios::trunc)
      << "this is a text, and it is long enough to be taken for a header.....";
  EXPECT_EQ(refusal(), map_errc::foreign);
}

TEST_F(map_file, damage_is_found_when_pages_are_checked) {
  for (std::uint64_t i = 1; i < 200; ++i)
    record(seen(i, place(100.0 * static_cast<double>(i))));
  close();
  {
    std::fstream file(folder.file(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(4096 * 3);
    file << std::string(4096, 'x');
  }
  const auto opened = open_map_for_writing({.path = folder.file(), .check_pages = true});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, map_errc::corrupt);
}

TEST_F(map_file, a_missing_one_is_made_only_when_that_is_wanted) {
  close();
  std::filesystem::remove_all(std::filesystem::path(folder.file()).parent_path());
  EXPECT_EQ(open_map_for_writing({.path = folder.file(), .create = false}).error().code, map_errc::missing);
  EXPECT_EQ(open_map_for_reading(folder.file()).error().code, map_errc::missing);
  open();
  EXPECT_TRUE(shown().empty());
}

} // namespace map_file_test
} // namespace godwit::mapobjects_store
