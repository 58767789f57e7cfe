#include "programs/godwit-sim/missions/exchange.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/read.hpp"
#include "messages/mission/answer.hpp"

namespace godwit::sim::missions {
namespace problem_answer_test {

mission::problem read_back(const answer& given) {
  const auto problem = mission::read<mission::problem>(given.body);
  EXPECT_TRUE(problem) << problem.error().message();
  EXPECT_EQ(given.content_type, problem_type);
  return problem.value_or(mission::problem{});
}

TEST(missions_problem_answer, a_problem_names_its_status_and_what_was_wrong) {
  const auto problem = read_back(problem_answer(409, "The mission is at revision 3."));
  EXPECT_EQ(problem.type, "about:blank");
  EXPECT_EQ(problem.title, "Conflict");
  EXPECT_EQ(problem.status, 409);
  EXPECT_EQ(problem.detail, "The mission is at revision 3.");
  EXPECT_EQ(read_back(problem_answer(418, "x")).title, "Status 418");
}

TEST(missions_problem_answer, whatever_is_wrong_the_document_keeps_its_schema) {
  std::vector<mission::document_problem> places(100, {std::string(3000, 'p'), std::string(999, 'x') + "\xc3\xa4", "y"});
  const auto problem = read_back(problem_answer(422, std::string(9000, 'd'), places));
  ASSERT_EQ(problem.errors.size(), 4U);                       // as many as a vehicle reads
  EXPECT_EQ(problem.errors[0].detail, std::string(999, 'x')); // no half of a character
  EXPECT_EQ(problem.detail->size(), 4000U);
  const std::vector<mission::document_problem> short_ones(100, {"/x", "is wrong", ""});
  EXPECT_EQ(read_back(problem_answer(422, "x", short_ones)).errors.size(), 64U);
}

TEST(missions_problem_answer, the_kind_of_mistake_in_a_body_decides_about_the_status) {
  using mission::document_errc;
  const std::vector<mission::document_problem> one{{"", "is wrong", ""}};
  EXPECT_EQ(problem_answer({document_errc::syntax, one}).status, 400U);
  EXPECT_EQ(problem_answer({document_errc::too_large, one}).status, 413U);
  for (const auto code : {document_errc::wrong_form, document_errc::other_version, document_errc::broken_rule})
    EXPECT_EQ(problem_answer({code, one}).status, 422U);
  EXPECT_EQ(read_back(problem_answer({document_errc::wrong_form, one, 5})).detail, "6 places are wrong.");
}

} // namespace problem_answer_test
} // namespace godwit::sim::missions
