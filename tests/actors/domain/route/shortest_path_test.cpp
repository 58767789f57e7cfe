#include "actors/domain/route/shortest_path.hpp"

#include <set>

#include <gtest/gtest.h>

namespace godwit::route {
namespace shortest_path_test {

const std::vector<local_point> places{{0, 0}, {10, 0}, {5, 1}, {5, 9}};
const auto everything = [](std::size_t, std::size_t) { return true; };

TEST(shortest_path, straight_when_the_end_is_in_sight) {
  EXPECT_EQ(shortest_path(places, 0, 1, everything), (std::vector<std::size_t>{0, 1}));
}

TEST(shortest_path, over_the_nearer_place_when_it_is_not) {
  const auto around = [](std::size_t from, std::size_t to) { return from + to != 1; };
  EXPECT_EQ(shortest_path(places, 0, 1, around), (std::vector<std::size_t>{0, 2, 1}));
}

TEST(shortest_path, none_when_nothing_leads_there) {
  const auto nothing_to_the_end = [](std::size_t from, std::size_t to) { return from != 1 && to != 1; };
  EXPECT_TRUE(shortest_path(places, 0, 1, nothing_to_the_end).empty());
}

TEST(shortest_path, no_pair_is_asked_for_twice) {
  std::multiset<std::pair<std::size_t, std::size_t>> asked;
  const auto noting = [&](std::size_t from, std::size_t to) {
    asked.emplace(from, to);
    return from + to != 1;
  };
  EXPECT_FALSE(shortest_path(places, 0, 1, noting).empty());
  for (const auto& each : asked)
    EXPECT_EQ(asked.count(each), 1U);
}

} // namespace shortest_path_test
} // namespace godwit::route
