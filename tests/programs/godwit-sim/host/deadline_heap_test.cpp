#include "programs/godwit-sim/host/deadline_heap.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace godwit::sim {
namespace deadline_heap_test {

TEST(deadline_heap, at_first_nobody_is_due) {
  const deadline_heap heap(3);
  EXPECT_EQ(heap.first_deadline(), deadline_heap::never);
}

TEST(deadline_heap, a_deadline_moves_both_ways) {
  deadline_heap heap(3);
  heap.set(0, 10);
  heap.set(1, 20);
  EXPECT_EQ(heap.first(), 0U);
  heap.set(0, 30);
  EXPECT_EQ(heap.first(), 1U);
  heap.set(2, 5);
  EXPECT_EQ(heap.first(), 2U);
  heap.set(2, deadline_heap::never);
  EXPECT_EQ(heap.first_deadline(), 20);
}

RC_GTEST_PROP(deadline_heap_property, the_first_is_always_the_least, ()) {
  const auto members = *rc::gen::inRange<std::size_t>(1, 40);
  const auto moves = *rc::gen::container<std::vector<std::pair<std::size_t, int>>>(
      rc::gen::pair(rc::gen::inRange<std::size_t>(0, members), rc::gen::inRange(0, 100)));
  deadline_heap heap(members);
  std::vector<std::int64_t> deadlines(members, deadline_heap::never);
  for (const auto& move : moves) {
    heap.set(move.first, move.second);
    deadlines[move.first] = move.second;
    RC_ASSERT(heap.first_deadline() == *std::min_element(deadlines.begin(), deadlines.end()));
    RC_ASSERT(deadlines[heap.first()] == heap.first_deadline());
  }
}

} // namespace deadline_heap_test
} // namespace godwit::sim
