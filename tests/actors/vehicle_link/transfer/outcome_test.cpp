#include "actors/vehicle_link/transfer/outcome.hpp"

#include <set>

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace outcome_test {

TEST(sentence_for_mission_result, each_result_has_its_own) {
  std::set<std::string> sentences;
  for (int result = 0; result <= 15; ++result)
    sentences.insert(sentence_for_mission_result(static_cast<std::uint8_t>(result)));
  EXPECT_EQ(sentences.size(), 16U);
}

TEST(sentence_for_mission_result, names_the_parameter) {
  EXPECT_NE(sentence_for_mission_result(8).find("parameter 3"), std::string::npos);
}

TEST(sentence_for_mission_result, names_a_number_that_is_not_known) {
  EXPECT_NE(sentence_for_mission_result(77).find("77"), std::string::npos);
}

} // namespace outcome_test
} // namespace godwit::vehicle_link::transfer
