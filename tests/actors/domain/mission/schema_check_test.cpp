#include "actors/domain/mission/schema_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/schema_store.hpp"
#include "io/json_schema/compiled_schema.hpp"
#include "io/json_schema/explain.hpp"
#include "tests/actors/domain/mission/document_maker.hpp"

namespace godwit::mission {
namespace schema_check_test {

using nlohmann::json;

TEST(schema_check, a_keyword_holds_only_of_what_it_is_about) {
  const schema_check size({{"minLength", 2}, {"maxLength", 3}, {"minimum", 1}});
  EXPECT_TRUE(size.holds("ab"));
  EXPECT_TRUE(size.holds("жж")); // two characters in four bytes
  EXPECT_FALSE(size.holds("abcd"));
  EXPECT_FALSE(size.holds(0.5));
  EXPECT_TRUE(size.holds(nullptr));
}

TEST(schema_check, a_bound_belongs_to_the_range_or_does_not) {
  const schema_check range({{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 500}});
  EXPECT_FALSE(range.holds(0));
  EXPECT_TRUE(range.holds(1e-300));
  EXPECT_TRUE(range.holds(500));
  EXPECT_FALSE(range.holds(500.0000001));
}

TEST(schema_check, properties_are_required_optional_or_unknown) {
  const schema_check closed({{"type", "object"},
                             {"additionalProperties", false},
                             {"required", {"b"}},
                             {"properties", {{"a", {{"type", "integer"}}}, {"b", json::object()}}}});
  EXPECT_TRUE(closed.holds({{"b", nullptr}}));
  EXPECT_TRUE(closed.holds({{"a", 1}, {"b", 1}}));
  EXPECT_FALSE(closed.holds({{"a", 1}}));
  EXPECT_FALSE(closed.holds({{"a", 1.0}, {"b", 1}}));
  for (const auto* unknown : {"", "aa", "c"})
    EXPECT_FALSE(closed.holds({{unknown, 1}, {"b", 1}})) << unknown;
}

// Three ways to judge by the same schemas. Whatever one of them let through would reach a vehicle or a map.
RC_GTEST_PROP(schema_check_property, it_agrees_with_valijson_and_with_the_sentences, (std::uint64_t seed)) {
  document_maker make(seed);
  int valid = 0;
  int wrong = 0;
  for (const auto& each : embedded_schemas()) {
    const auto& schema = schema_named(each.name);
    const schema_check check(schema);
    const io::schemas::compiled_schema by_valijson(schema);
    for (int i = 0; i < 10 && schema.contains("type"); ++i) {
      auto document = make.document(schema);
      for (int damages = make.whole(0, 2); damages > 0; --damages)
        make.damage(document);
      const bool holds = check.holds(document);
      (holds ? valid : wrong) += 1;
      if (holds != by_valijson.holds(document))
        RC_FAIL("valijson disagrees by " + std::string(each.name) + " about " + document.dump());
      if (holds != io::schemas::explain(document, schema, 32).empty())
        RC_FAIL("the sentences disagree by " + std::string(each.name) + " about " + document.dump());
    }
  }
  RC_ASSERT(valid > 0 && wrong > 0);
}

} // namespace schema_check_test
} // namespace godwit::mission
