#include "actors/domain/mission/judge.hpp"

#include <functional>
#include <map>
#include <string>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "actors/domain/mission/explain.hpp"
#include "actors/domain/mission/schema_check.hpp"
#include "actors/domain/mission/schema_store.hpp"
#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;
using valijson::adapters::NlohmannJsonAdapter;

struct judged_schema {
  explicit judged_schema(const json& schema) : quick(schema) {
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(NlohmannJsonAdapter(schema), by_valijson);
  }
  schema_check quick;
  valijson::Schema by_valijson;
};

// Made once: to prepare a schema takes longer than to judge a small document by it.
const judged_schema& prepared(std::string_view name) {
  using schema_map = std::map<std::string, judged_schema, std::less<>>;
  static const schema_map all = [] {
    schema_map made;
    for (const auto& each : embedded_schemas())
      made.try_emplace(std::string(each.name), schema_named(each.name));
    return made;
  }();
  const auto found = all.find(name);
  GODWIT_ASSERT(found != all.end(), "there is a schema " + std::string(name));
  return found->second;
}

} // namespace

bool is_valid_for_valijson(const json& document, std::string_view schema_name) {
  thread_local valijson::Validator validator(valijson::Validator::kStrongTypes); // it keeps its regular expressions
  return validator.validate(prepared(schema_name).by_valijson, NlohmannJsonAdapter(document), nullptr);
}

std::vector<document_problem> violations(const json& document, std::string_view schema_name, judges asked) {
  const bool is_valid = prepared(schema_name).quick.holds(document) &&
                        (asked == judges::quick || is_valid_for_valijson(document, schema_name));
  if (is_valid)
    return {};
  auto problems = explain(document, schema_named(schema_name));
  if (problems.empty()) // the judges disagree: what comes from outside must not end the process
    problems.push_back({{}, "is not what its schema allows", {}});
  return problems;
}

} // namespace godwit::mission
