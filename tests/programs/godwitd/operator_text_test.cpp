#include "programs/godwitd/operator_text.hpp"

#include <gtest/gtest.h>

namespace operator_text_test {

using namespace godwit::daemon;
using nlohmann::json;

TEST(operator_text, a_row_of_the_audit_says_when_who_what_and_what_came_of_it) {
  const json row{{"at_ns", 1'800'000'000'900'000'000},
                 {"who", {{"name", "anna"}, {"role", "operator"}, {"session", "s7"}}},
                 {"what", "start"},
                 {"outcome", "refused"},
                 {"reason", "not ready"},
                 {"count", 2}};
  EXPECT_EQ(audit_text({{"rows", {row}}}),
            "2027-01-15T08:00:00Z  anna (operator, s7): start: refused, 2 times (not ready)");
  EXPECT_EQ(audit_text({{"rows", json::array()}}), "there are no entries");
  auto numbered = row;
  numbered["number"] = 1'200;
  EXPECT_EQ(audit_text({{"rows", {numbered}}, {"has_older", true}}).substr(0, 46),
            "older rows: godwitd ctl audit --before 1200\n20");
}

TEST(operator_text, a_stranger_is_shown_as_one) {
  const json row{{"at_ns", 0}, {"who", {{"name", "mallory"}}}, {"what", "start"}, {"outcome", "no_session"}};
  EXPECT_EQ(audit_text({{"rows", {row}}}), "1970-01-01T00:00:00Z  mallory (unknown): start: no_session");
}

TEST(operator_text, who_has_control_is_said) {
  EXPECT_EQ(control_text({{"holder", "anna"}}), "anna has control");
  EXPECT_EQ(control_text({{"holder", ""}}), "control is free");
  const json anna{{"name", "anna"}, {"role", "operator"}, {"session", "s7"}};
  EXPECT_EQ(operators_line({{"control", {{"who", anna}}}, {"sessions", {{{"who", anna}}}}}),
            "anna has control, anna (operator, s7)");
  EXPECT_EQ(operators_line({{"control", nullptr}, {"sessions", json::array()}}), "control is free");
}

} // namespace operator_text_test
