#include "actors/domain/mission/write.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "tests/actors/domain/mission/mission_maker.hpp"

namespace godwit::mission {
namespace write_test {

TEST(write_mission, what_is_absent_is_left_out) {
  EXPECT_EQ(to_text(geofence{fence_kind::exclusion, {{1, 2}}, {}, 120}),
            R"({"kind":"EXCLUSION","vertices":[{"latitude":1,"longitude":2}],"ceiling_m":120})");
  EXPECT_EQ(to_text(map_object_page{"1.0.0", {}, {}}), R"({"schema_version":"1.0.0","map_objects":[]})");
}

RC_GTEST_PROP(write_mission_property, a_valid_mission_reads_back_as_itself, ()) {
  const auto mission = mission_maker(*rc::gen::arbitrary<std::uint64_t>()).mission();
  const auto again = read<document>(to_text(mission));
  if (!again)
    RC_FAIL(again.error().message());
  RC_ASSERT(again.value() == mission);
}

RC_GTEST_PROP(write_mission_property, any_text_as_an_id_comes_back, ()) {
  auto mission = mission_maker(1).mission(1);
  const auto id = *rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127)));
  RC_PRE(id.size() <= 64);
  mission.items = {return_home{id}};
  const auto again = read<document>(to_text(mission));
  RC_ASSERT(again.has_value());
  RC_ASSERT(again.value() == mission);
}

// Any damage to a valid text is refused with a sentence, or gives a mission that is written and read as itself.
RC_GTEST_PROP(write_mission_property, a_damaged_text_is_refused_or_keeps_the_rules, ()) {
  auto text = to_text(mission_maker(*rc::gen::arbitrary<std::uint64_t>()).mission(4));
  for (int i = *rc::gen::inRange(1, 4); i > 0; --i)
    text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
  const auto result = read<document>(text);
  if (result)
    RC_ASSERT(read<document>(to_text(*result)).value() == *result);
  else
    RC_ASSERT(!result.error().message().empty());
}

} // namespace write_test
} // namespace godwit::mission
