#include "actors/domain/mission/judge.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/json_document.hpp"
#include "actors/domain/mission/read.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace judge_test {

using nlohmann::json;

TEST(judge, both_judges_accept_a_good_mission) {
  const auto mission = json::parse(sample_file("every_kind.json"));
  EXPECT_TRUE(violations(mission, "mission", judge::valijson).empty());
  EXPECT_TRUE(violations(mission, "mission", judge::for_rows).empty());
}

// valijson takes 2^64 - 1 for -1, which is a good latitude, and counts no character in a zero: such documents are not
// let as far as to it.
TEST(judge, what_valijson_would_let_through_is_refused_before) {
  auto mission = json::parse(sample_file("every_kind.json"));
  mission["return_point"]["latitude"] = 18'446'744'073'709'551'615U;
  EXPECT_FALSE(read<document>(mission.dump()));
  mission["return_point"]["latitude"] = 0;
  EXPECT_TRUE(read<document>(mission.dump()));
  mission["items"][0]["id"] = std::string(1, '\0');
  EXPECT_FALSE(read<document>(mission.dump()));
}

TEST(judge, only_lists_of_rows_are_not_judged_by_valijson) {
  EXPECT_EQ(form_of<document>.by, judge::valijson);
  EXPECT_EQ(form_of<assignment_list>.by, judge::valijson);
  EXPECT_EQ(form_of<tail>.by, judge::valijson);
  EXPECT_EQ(form_of<problem>.by, judge::valijson);
  EXPECT_EQ(form_of<map_object_page>.by, judge::for_rows);
  EXPECT_EQ(form_of<map_object_bundle>.by, judge::for_rows);
}

TEST(judge, a_million_unknown_properties_are_not_told_one_by_one) {
  std::string text = "{";
  for (int i = 0; i < 300'000; ++i)
    text += (i == 0 ? "\"k" : ",\"k") + std::to_string(i) + "\":0";
  const auto document = parse_document(text + "}", max_mission_bytes);
  ASSERT_TRUE(document.has_value());
  EXPECT_LE(violations(*document, "mission", judge::valijson).size(), max_document_problems + 10);
}

} // namespace judge_test
} // namespace godwit::mission
