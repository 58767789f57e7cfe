#include "actors/mission_client/outbox/keys.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace keys_test {

using namespace godwit;
using namespace godwit::mission_client;

bool is_uuid(const std::string& text, char version) {
  return std::regex_match(text, std::regex(std::string("[0-9a-f]{8}-[0-9a-f]{4}-") + version +
                                           "[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"));
}

TEST(mission_client_keys, fresh_keys_are_uuids_and_differ) {
  runtime::random_source random(7);
  std::set<std::string> seen;
  for (int i = 0; i < 1'000; ++i) {
    const auto key = fresh_key(random);
    EXPECT_TRUE(is_uuid(key, '4')) << key;
    seen.insert(key);
  }
  EXPECT_EQ(seen.size(), 1'000U);
}

TEST(mission_client_keys, the_same_cut_has_the_same_key_and_every_other_cut_another_one) {
  std::vector<std::string> names;
  for (int i = 0; i < 30; ++i)
    names.push_back("key-" + std::to_string(i));
  std::set<std::string> seen;
  for (std::size_t from = 0; from < names.size(); ++from)
    for (auto upto = from + 1; upto <= names.size(); ++upto) {
      const std::vector<std::string_view> cut(names.begin() + static_cast<std::ptrdiff_t>(from),
                                              names.begin() + static_cast<std::ptrdiff_t>(upto));
      const auto key = derived_key(cut);
      EXPECT_TRUE(is_uuid(key, '8')) << key;
      EXPECT_EQ(key, derived_key(cut));
      seen.insert(key);
    }
  EXPECT_EQ(seen.size(), 30U * 31U / 2U);
  EXPECT_NE(derived_key({"ab", "c"}), derived_key({"a", "bc"}));
}

} // namespace keys_test
