#include "actors/domain/uuid/uuid.hpp"

#include <set>

#include <gtest/gtest.h>

#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::ids {
namespace uuid_test {

TEST(uuid, only_small_letters_and_dashes_at_their_places_are_one) {
  EXPECT_TRUE(is_uuid("0123abcd-0000-4000-8000-0123456789ef"));
  for (const auto* bad : {"", "0123ABCD-0000-4000-8000-0123456789ef", "0123abcd-0000-4000-8000-0123456789e",
                          "0123abcd00004000800001234567", "0123abcd-0000-4000-80000-123456789ef",
                          "0123abcg-0000-4000-8000-0123456789ef", "{123abcd-0000-4000-8000-0123456789ef"})
    EXPECT_FALSE(is_uuid(bad)) << bad;
}

TEST(uuid, a_derived_one_is_the_same_every_time_and_has_version_8) {
  const auto derived = derived_uuid(tests::uuid(1), tests::uuid(2));
  EXPECT_TRUE(is_uuid(derived));
  EXPECT_EQ(derived, derived_uuid(tests::uuid(1), tests::uuid(2)));
  EXPECT_EQ(derived[14], '8');
  EXPECT_NE(std::string("89ab").find(derived[19]), std::string::npos);
}

TEST(uuid, different_pairs_give_different_ones) {
  std::set<std::string> derived;
  for (std::uint64_t first = 0; first < 100; ++first)
    for (std::uint64_t second = 0; second < 100; ++second)
      derived.insert(derived_uuid(tests::uuid(first), tests::uuid(second)));
  EXPECT_EQ(derived.size(), 10'000U);
}

} // namespace uuid_test
} // namespace godwit::ids
