#include "programs/godwit-sim/missions/outgoing.hpp"

#include <gtest/gtest.h>

namespace godwit::sim::missions {
namespace {

delivery of_body(const std::string& body) { return {.what = {.body = body, .headers = {}}, .cut_after = {}}; }

std::string all_of(outgoing& from, std::size_t piece) {
  std::string all;
  while (!from.is_at_end())
    all += from.take(piece);
  return all;
}

TEST(missions_outgoing, an_answer_is_the_same_in_any_pieces) {
  const std::string expected = "HTTP/1.1 200 \r\nContent-Type: application/json\r\nContent-Length: 5\r\n\r\nhello";
  for (const std::size_t piece : {1U, 7U, 4096U}) {
    outgoing out(of_body("hello"), false);
    EXPECT_EQ(all_of(out, piece), expected);
  }
}

TEST(missions_outgoing, the_last_answer_says_so_and_204_has_no_body) {
  auto last = of_body("");
  last.what.status = 204;
  last.what.content_type.clear();
  last.what.headers.emplace_back("Retry-After", "1");
  outgoing out(last, true);
  EXPECT_EQ(all_of(out, 4096), "HTTP/1.1 204 \r\nRetry-After: 1\r\nConnection: close\r\n\r\n");
}

TEST(missions_outgoing, a_body_that_is_cut_still_promises_all_of_it) {
  auto cut = of_body("0123456789");
  cut.cut_after = 4;
  outgoing out(cut, false);
  const auto all = all_of(out, 4096);
  EXPECT_NE(all.find("Content-Length: 10\r\n"), std::string::npos);
  EXPECT_TRUE(all.ends_with("\r\n\r\n0123"));
}

TEST(missions_outgoing, padding_is_spaces_that_are_never_all_in_memory) {
  auto padded = of_body("{}");
  padded.padding = 200'000;
  outgoing out(padded, false);
  std::size_t most = 0;
  std::size_t all = 0;
  while (!out.is_at_end()) {
    const auto piece = out.take(1'000'000);
    ASSERT_FALSE(piece.empty());
    most = std::max(most, piece.size());
    all += piece.size();
  }
  EXPECT_LE(most, 64U * 1024);
  EXPECT_GT(all, 200'000U);
}

} // namespace
} // namespace godwit::sim::missions
