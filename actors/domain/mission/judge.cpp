#include "actors/domain/mission/judge.hpp"

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "actors/domain/mission/schema_check.hpp"
#include "actors/domain/mission/schema_store.hpp"
#include "io/json_schema/compiled_schema.hpp"
#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;
namespace json_schema = io::schemas;

struct prepared_schema {
  explicit prepared_schema(const json& schema) : by_valijson(schema), for_rows(schema) {}

  json_schema::compiled_schema by_valijson;
  schema_check for_rows;
};

// Made once: to prepare a schema takes longer than to judge a small document by it.
const prepared_schema& prepared(std::string_view name) {
  using schema_map = std::map<std::string, prepared_schema, std::less<>>;
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

std::string pointer_of(const json_schema::place& where) {
  std::string pointer;
  for (const auto& each : where)
    pointer = std::visit([&](const auto& to) { return pointer_to(pointer, to); }, each);
  return pointer;
}

} // namespace

std::vector<document_problem> violations(const json& document, std::string_view schema_name, judge by) {
  const auto& schema = prepared(schema_name);
  if (by == judge::for_rows ? schema.for_rows.holds(document) : schema.by_valijson.holds(document))
    return {};
  std::vector<document_problem> problems;
  for (auto& each : schema.by_valijson.explain_wrong(document, max_document_problems))
    problems.push_back({pointer_of(each.where), std::move(each.what), std::move(each.allowed)});
  return problems;
}

} // namespace godwit::mission
