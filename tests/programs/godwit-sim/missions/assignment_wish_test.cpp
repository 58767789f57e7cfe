#include "programs/godwit-sim/missions/assignment_wish.hpp"

#include <gtest/gtest.h>

namespace godwit::sim::missions {
namespace {

TEST(missions_assignment_wish, what_is_left_out_is_left_open) {
  const auto wish = parse_assignment_wish(R"({"items": [{"id": "h", "kind": "return"}]})").value();
  EXPECT_EQ(wish.items, (std::vector<mission::item>{mission::return_home{"h"}}));
  EXPECT_FALSE(wish.replace_after_item_id || wish.assignment_id || wish.base_revision || wish.revision);
  const auto full = parse_assignment_wish(R"({"items": [{"id": "h", "kind": "return"}], "base_revision": 4,
    "revision": 9, "replace_after_item_id": "w1", "assignment_id": "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11"})")
                        .value();
  EXPECT_EQ(full.base_revision, 4);
  EXPECT_EQ(full.revision, 9);
  EXPECT_EQ(full.replace_after_item_id, "w1");
  EXPECT_EQ(full.assignment_id, "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11");
}

TEST(missions_assignment_wish, a_mistake_is_named_with_its_place) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"", "is not JSON"},
      {"[]", "allowed: an assignment"},
      {"{}", "/items is missing"},
      {R"({"items": []})", "/items"},
      {R"({"items": [{"id": "h", "kind": "fly"}]})", "/items/0/kind"},
      {R"({"items": [{"id": "h", "kind": "return"}], "base_revision": "two"})", "/base_revision"},
      {R"({"items": [{"id": "h", "kind": "return"}], "when": 1})", "/when"},
  };
  for (const auto& [text, part] : mistakes) {
    const auto wish = parse_assignment_wish(text);
    ASSERT_FALSE(wish) << text;
    EXPECT_NE(wish.error().find(part), std::string::npos) << wish.error();
  }
}

} // namespace
} // namespace godwit::sim::missions
