#include "actors/mission_client/outbox/recorded_answer.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace recorded_answer_test {

using namespace godwit::mission_client;

service_news answer_of(std::string body) {
  return {
      42,
      {.number = 7, .how = ending::answered, .status = 200, .body = std::move(body), .retry_after_ns = 5, .error = {}}};
}

service_news put_together(const service_news& from, std::uint32_t expected_parts) {
  std::size_t at = 0;
  auto first = next_part(from, at);
  EXPECT_EQ(first.parts, expected_parts);
  const auto parts = first.parts;
  auto result = news_of(std::move(first));
  for (std::uint32_t n = 1; n < parts; ++n) {
    const auto part = next_part(from, at);
    EXPECT_LE(part.body.size(), answer_part_bytes);
    result.what.body += part.body;
  }
  return result;
}

TEST(recorded_answer, a_long_body_comes_back_whole_and_cut_between_characters) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, answer_part_bytes, answer_part_bytes + 1, 5 * answer_part_bytes - 1}) {
    const auto parts =
        static_cast<std::uint32_t>(std::max<std::size_t>((size + answer_part_bytes - 1) / answer_part_bytes, 1));
    const auto from = answer_of(std::string(size, 'x'));
    const auto back = put_together(from, parts);
    EXPECT_EQ(back.call, from.call);
    EXPECT_EQ(back.what.status, 200U);
    EXPECT_EQ(back.what.retry_after_ns, 5);
    EXPECT_EQ(back.what.body, from.what.body) << size;
  }
  std::string umlauts;
  while (umlauts.size() < 3 * answer_part_bytes)
    umlauts += "\xC3\xBC";
  umlauts.insert(0, 1, 'x'); // each cut would fall into one
  EXPECT_EQ(put_together(answer_of(umlauts), 4).what.body, umlauts);
}

TEST(recorded_answer, a_body_above_the_bound_is_one_part) {
  const auto from = answer_of(std::string(max_recorded_body_bytes + 1, 'x'));
  std::size_t at = 0;
  EXPECT_EQ(next_part(from, at).parts, 1U);
}

TEST(recorded_answer, bytes_that_are_no_text_come_to_an_end) {
  EXPECT_EQ(put_together(answer_of(std::string(3, '\x80')), 1).what.body.size(), 3U);
  const auto from = answer_of(std::string(answer_part_bytes + 10, '\x80'));
  std::size_t at = 0;
  EXPECT_GT(next_part(from, at).parts, 1U);
}

} // namespace recorded_answer_test
