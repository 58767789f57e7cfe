#include "programs/godwit-sim/missions/service_file.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/missions/missions_fixture.hpp"

namespace godwit::sim::missions {
namespace service_file_test {

TEST(missions_service_file, the_file_of_another_program_is_left_alone) {
  scratch folder;
  const auto name = folder.file("other.db");
  {
    auto other = io::sqlite::database::open(name, {.mode = io::sqlite::open_mode::create}).value();
    ASSERT_TRUE(other.exec("CREATE TABLE theirs(x)"));
  }
  const auto refused = service_file::open(name);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find("name a file that does not exist yet"), std::string::npos) << refused.error();
}

TEST(missions_service_file, a_file_of_another_version_is_refused) {
  scratch folder;
  const auto name = folder.file("missions.db");
  ASSERT_TRUE(service_file::open(name));
  ASSERT_TRUE(io::sqlite::database::open(name, {}).value().exec("PRAGMA user_version=99"));
  EXPECT_FALSE(service_file::open(name));
}

TEST(missions_service_file, the_first_error_is_kept_and_nothing_runs_until_it_is_taken) {
  scratch folder;
  const auto file = service_file::open(folder.file("missions.db")).value();
  file->begin();
  file->run("INSERT INTO map_objects(mission_id, object_id, text) VALUES ('m', 'a', 'one')");
  file->run("INSERT INTO nothing VALUES (1)");
  file->run("INSERT INTO map_objects(mission_id, object_id, text) VALUES ('m', 'b', 'two')");
  EXPECT_TRUE(file->has_failed());
  EXPECT_FALSE(file->commit());
  EXPECT_NE(file->take_error().find("nothing"), std::string::npos);
  EXPECT_EQ(file->number("SELECT COUNT(*) FROM map_objects"), 0);
  EXPECT_EQ(file->take_error(), "");
}

} // namespace service_file_test
} // namespace godwit::sim::missions
