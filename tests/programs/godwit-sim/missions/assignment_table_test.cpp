#include "programs/godwit-sim/missions/assignment_table.hpp"

#include <gtest/gtest.h>

namespace godwit::sim::missions {
namespace assignment_request_test {

TEST(missions_assignment_request, what_is_left_out_is_left_open) {
  const auto wanted = parse_assignment_request(R"({"items": [{"id": "h", "kind": "return"}]})").value();
  EXPECT_EQ(wanted.items, (std::vector<mission::item>{mission::return_home{"h"}}));
  EXPECT_FALSE(wanted.replace_after_item_id || wanted.assignment_id || wanted.base_revision || wanted.revision);
  const auto full = parse_assignment_request(R"({"items": [{"id": "h", "kind": "return"}], "base_revision": 4,
    "revision": 9, "replace_after_item_id": "w1", "assignment_id": "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11"})")
                        .value();
  EXPECT_EQ(full.base_revision, 4);
  EXPECT_EQ(full.revision, 9);
  EXPECT_EQ(full.replace_after_item_id, "w1");
  EXPECT_EQ(full.assignment_id, "0b8f7c36-3a5f-4c0b-8f0e-5e5f2f6f9b11");
}

TEST(missions_assignment_request, a_mistake_is_named_with_its_place) {
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
    const auto wanted = parse_assignment_request(text);
    ASSERT_FALSE(wanted) << text;
    EXPECT_NE(wanted.error().find(part), std::string::npos) << wanted.error();
  }
}

} // namespace assignment_request_test
} // namespace godwit::sim::missions
