#include "programs/godwitd/configuration.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwitd/scratch.hpp"

namespace configuration_test {

using namespace godwit;
using namespace godwit::daemon;

TEST(configuration, the_command_line_stands_above_the_environment_above_the_file_above_the_defaults) {
  const test::scratch folder;
  const auto file = folder.write("godwit.json", R"({"journal": {"path": "file.db"}, "map": {"path": "file.map"},
                                                   "trace": {"directory": "file.trace"}})");
  const auto all = effective_configuration({{"config", file}, {"journal", "line.db"}},
                                           {{"GODWIT_JOURNAL", "variable.db"}, {"GODWIT_MAP", "variable.map"}});
  ASSERT_TRUE(all) << all.error();
  EXPECT_EQ(all->at("journal").at("path"), "line.db");
  EXPECT_EQ(all->at("map").at("path"), "variable.map");
  EXPECT_EQ(all->at("trace").at("directory"), "file.trace");
  EXPECT_EQ(all->at("trace").at("flush_ms"), 100);
}

TEST(configuration, the_file_can_be_named_in_the_environment) {
  const test::scratch folder;
  const auto file = folder.write("godwit.json", R"({"map": {"path": "file.map"}})");
  const auto all = effective_configuration({}, {{"GODWIT_CONFIG", file}});
  ASSERT_TRUE(all) << all.error();
  EXPECT_EQ(all->at("map").at("path"), "file.map");
}

TEST(configuration, a_flag_in_the_environment_is_true_1_false_or_0) {
  for (const auto* yes : {"true", "1"})
    EXPECT_EQ(effective_configuration({}, {{"GODWIT_ONCE", yes}})->at("sightings").at("once"), true) << yes;
  for (const auto* no : {"false", "0"})
    EXPECT_EQ(effective_configuration({}, {{"GODWIT_ONCE", no}})->at("sightings").at("once"), false) << no;
}

TEST(configuration, a_wrong_variable_is_named) {
  const auto wrong = effective_configuration({}, {{"GODWIT_ONCE", "perhaps"}});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error(), "GODWIT_ONCE is \"perhaps\"; allowed: true or false");
}

TEST(configuration, a_wrong_option_is_named) {
  const auto wrong = effective_configuration({{"journal", ""}}, {});
  ASSERT_FALSE(wrong);
  EXPECT_TRUE(wrong.error().starts_with("--journal ")) << wrong.error();
}

TEST(configuration, a_variable_that_nobody_knows_is_an_error_with_the_nearest_name) {
  const auto wrong = effective_configuration({}, {{"GODWIT_TOKN_FILE", "token"}});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().find("GODWIT_TOKN_FILE"), std::string::npos);
  EXPECT_NE(wrong.error().find("GODWIT_TOKEN_FILE"), std::string::npos);
}

TEST(configuration, a_mistake_in_the_file_is_told_with_its_place) {
  const test::scratch folder;
  const auto file = folder.write("godwit.json", R"({"service": {"token": "abc"}})");
  const auto wrong = effective_configuration({{"config", file}}, {});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().find("service.token"), std::string::npos) << wrong.error();
}

} // namespace configuration_test
