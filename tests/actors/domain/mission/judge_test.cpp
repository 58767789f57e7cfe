#include "actors/domain/mission/judge.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/json_document.hpp"
#include "actors/domain/mission/read.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace {

using nlohmann::json;

TEST(judge, both_judges_accept_a_good_mission) {
  const auto mission = json::parse(sample_file("every_kind.json"));
  EXPECT_TRUE(violations(mission, "mission", judges::quick).empty());
  EXPECT_TRUE(violations(mission, "mission", judges::both).empty());
}

// valijson takes it for -1, which is a good latitude.
TEST(judge, what_only_one_judge_refuses_is_refused_and_never_ends_the_process) {
  auto mission = json::parse(sample_file("every_kind.json"));
  mission["return_point"]["latitude"] = 18'446'744'073'709'551'615U;
  EXPECT_TRUE(is_valid_for_valijson(mission, "mission"));
  EXPECT_FALSE(violations(mission, "mission", judges::both).empty());
  mission["return_point"]["latitude"] = 0;
  mission["items"][0]["id"] = std::string(1, '\0'); // valijson counts no character in it
  EXPECT_FALSE(violations(mission, "mission", judges::both).empty());
}

TEST(judge, what_a_vehicle_is_to_fly_is_judged_by_both) {
  EXPECT_EQ(form_of<document>.asked, judges::both);
  EXPECT_EQ(form_of<assignment_list>.asked, judges::both);
  EXPECT_EQ(form_of<tail>.asked, judges::both);
}

TEST(judge, a_million_unknown_properties_are_not_told_one_by_one) {
  std::string text = "{";
  for (int i = 0; i < 300'000; ++i)
    text += (i == 0 ? "\"k" : ",\"k") + std::to_string(i) + "\":0";
  const auto document = parse_document(text + "}", max_mission_bytes);
  ASSERT_TRUE(document.has_value());
  EXPECT_LE(violations(*document, "mission", judges::both).size(), max_document_problems + 10);
}

} // namespace
} // namespace godwit::mission
