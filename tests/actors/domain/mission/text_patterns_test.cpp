#include "actors/domain/mission/text_patterns.hpp"

#include <functional>
#include <map>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/schema_store.hpp"

namespace godwit::mission {
namespace text_patterns_test {

using nlohmann::json;

void add_patterns(const json& value, std::map<std::string, std::regex>& patterns) {
  if (value.is_object() && value.contains("pattern") && value["pattern"].is_string())
    patterns.try_emplace(value["pattern"].get<std::string>(), value["pattern"].get<std::string>());
  if (value.is_structured())
    for (const auto& each : value)
      add_patterns(each, patterns);
}

const std::map<std::string, std::regex>& patterns_of_the_schemas() {
  static const auto all = [] {
    std::map<std::string, std::regex> found;
    for (const auto& each : embedded_schemas())
      add_patterns(schema_named(each.name), found);
    return found;
  }();
  return all;
}

TEST(text_patterns, each_pattern_of_the_schemas_has_its_function) {
  EXPECT_EQ(patterns_of_the_schemas().size(), 4U);
  for (const auto& [pattern, expression] : patterns_of_the_schemas())
    EXPECT_FALSE(test_of_pattern(pattern)("")) << pattern;
}

// Texts of each kind, damaged at up to two places by letters that matter to one of the patterns.
std::string any_text(std::mt19937_64& random) {
  static const std::vector<std::string> samples{"7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42",
                                                "2026-05-04T10:15:30Z",
                                                "2026-05-04T10:15:30.123456789Z",
                                                "2026-05-04T10:15:30.1Z",
                                                "1.0.0",
                                                "0.999999.10",
                                                "32TNS1234567890",
                                                "4QFJ12",
                                                "ZAH",
                                                ""};
  static const std::string letters = "0123456789abcdfgTZABCIOXYz.-:\n ";
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  auto text = samples[below(samples.size())];
  for (auto damages = below(3); damages > 0; --damages) {
    const auto at = below(text.size() + 1);
    if (below(3) == 0 && at < text.size())
      text.erase(at, 1);
    else if (below(2) == 0 && at < text.size())
      text[at] = letters[below(letters.size())];
    else
      text.insert(at, 1, letters[below(letters.size())]);
  }
  return text;
}

RC_GTEST_PROP(text_patterns_property, each_function_agrees_with_its_pattern, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 500; ++i) {
    const auto text = any_text(random);
    for (const auto& [pattern, expression] : patterns_of_the_schemas())
      if (test_of_pattern(pattern)(text) != std::regex_search(text, expression))
        RC_FAIL("they disagree about " + json(text).dump() + " and " + pattern);
  }
}

} // namespace text_patterns_test
} // namespace godwit::mission
