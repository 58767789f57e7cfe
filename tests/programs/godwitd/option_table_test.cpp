#include "programs/godwitd/option_table.hpp"

#include <gtest/gtest.h>

#include <set>

#include <nlohmann/json.hpp>

#include "runtime/config/config.hpp"

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
