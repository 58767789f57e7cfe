#include "actors/mission_client/judgement.hpp"

#include <gtest/gtest.h>

#include "actors/mission_client/outbox/outbox.hpp"

namespace judgement_test {

using namespace godwit::mission_client;

service_answer status(unsigned value, std::string body = {}) { return {.status = value, .body = std::move(body)}; }

TEST(mission_client_judgement, each_status_means_what_the_contract_says) {
  const std::vector<std::pair<unsigned, judgement>> table{
      {200, judgement::success},   {201, judgement::success},     {301, judgement::misconfigured},
      {400, judgement::wrong},     {401, judgement::not_allowed}, {403, judgement::not_allowed},
      {404, judgement::not_found}, {408, judgement::transient},   {409, judgement::conflict},
      {410, judgement::gone},      {413, judgement::wrong},       {418, judgement::wrong},
      {422, judgement::wrong},     {429, judgement::transient},   {500, judgement::transient},
      {502, judgement::transient}, {503, judgement::transient},   {504, judgement::transient},
      {100, judgement::bad_answer}};
  for (const auto& [value, meaning] : table)
    EXPECT_EQ(judge(status(value)), meaning) << value;
}

TEST(mission_client_judgement, without_an_answer_the_network_decides_what_it_means) {
  EXPECT_EQ(judge({.how = ending::not_reached}), judgement::transient);
  EXPECT_EQ(judge({.how = ending::misconfigured}), judgement::misconfigured);
  EXPECT_EQ(judge({.how = ending::bad_answer}), judgement::bad_answer);
}

TEST(mission_client_judgement, what_the_service_says_about_it_reaches_the_person) {
  EXPECT_EQ(sentence_of(status(422, R"({"title":"Unprocessable","status":422,"detail":"1 place is wrong.",)"
                                    R"("errors":[{"pointer":"/at","detail":"is 95"}]})")),
            "the service answered 422 Unprocessable: 1 place is wrong. /at is 95.");
  EXPECT_EQ(sentence_of(status(503, "<html>")), "the service answered 503");
  EXPECT_EQ(sentence_of({.how = ending::not_reached, .error = "nobody listens there"}), "nobody listens there");
}

TEST(mission_client_judgement, a_long_sentence_is_cut) {
  EXPECT_EQ(sentence_of({.how = ending::not_reached, .error = std::string(10'000, 'x')}).size(), max_error_text);
}

} // namespace judgement_test
