#include "programs/godwit-sim/missions/fault_book.hpp"

#include <gtest/gtest.h>

namespace godwit::sim::missions {
namespace fault_book_test {

TEST(missions_fault_book, a_fault_hits_the_calls_that_it_is_meant_for_from_its_first_to_its_last) {
  fault_book book;
  ASSERT_TRUE(book.add("lose on post-progress from 2 times 3"));
  ASSERT_TRUE(book.add("delay 1ms"));
  std::string hits;
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(book.hit_by_call(endpoint::get_mission).size(), 1U);
    hits += std::to_string(book.hit_by_call(endpoint::post_progress).size());
  }
  EXPECT_EQ(hits, "122211");
  const auto figures = book.figures();
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].spec, "lose on post-progress from 2 times 3");
  EXPECT_EQ(figures[0].seen, 6U);
  EXPECT_EQ(figures[0].hit, 3U);
  EXPECT_EQ(figures[1].hit, 12U);
  book.clear();
  EXPECT_TRUE(book.hit_by_call(endpoint::post_progress).empty());
}

TEST(missions_fault_book, faults_of_connections_hit_no_call) {
  fault_book book;
  ASSERT_TRUE(book.add("refuse"));
  ASSERT_TRUE(book.add("wrong-host from 2 times 1"));
  EXPECT_TRUE(book.hit_by_call(endpoint::get_mission).empty());
  EXPECT_TRUE(book.refuses());
  EXPECT_FALSE(book.next_is_wrong_host());
  EXPECT_TRUE(book.next_is_wrong_host());
  EXPECT_FALSE(book.next_is_wrong_host());
  book.end_refusal();
  EXPECT_FALSE(book.refuses());
}

TEST(missions_fault_book, there_are_only_so_many) {
  fault_book book;
  for (std::size_t i = 0; i < fault_book::max_faults; ++i)
    ASSERT_TRUE(book.add("lose"));
  EXPECT_FALSE(book.add("lose"));
}

} // namespace fault_book_test
} // namespace godwit::sim::missions
