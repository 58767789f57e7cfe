#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwitd/configuration.hpp"
#include "runtime/config/config.hpp"
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

namespace option_table_test {

using namespace godwit;

using namespace godwit::daemon;

TEST(option_table, a_variable_is_the_option_in_capitals) {
  EXPECT_EQ(variable_of(*find_option("token-file")), "GODWIT_TOKEN_FILE");
  EXPECT_EQ(variable_of(*find_option("service")), "GODWIT_SERVICE");
}

TEST(option_table, each_option_has_a_place_of_its_own_in_the_configuration) {
  const auto defaults = runtime::load_config("{}", "defaults", runtime::godwit_schema()).value();
  std::set<std::string_view> places;
  for (const auto& row : option_rows) {
    if (row.place.empty())
      continue;
    EXPECT_TRUE(places.insert(row.place).second) << row.place;
    const nlohmann::json::json_pointer place{std::string(row.place)};
    ASSERT_TRUE(defaults.contains(place)) << row.place;
    EXPECT_EQ(defaults.at(place).is_boolean(), row.kind == option_kind::flag) << row.place;
  }
}

TEST(option_table, an_option_can_be_named_in_all_three_ways) {
  EXPECT_EQ(all_names_of("token-file"), "--token-file (GODWIT_TOKEN_FILE, service.token_file)");
}

} // namespace option_table_test
