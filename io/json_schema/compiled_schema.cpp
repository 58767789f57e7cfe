#include "io/json_schema/compiled_schema.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "io/json_schema/explain.hpp"

namespace godwit::io::schemas {

namespace {

using nlohmann::json;
using valijson::adapters::NlohmannJsonAdapter;

bool is_valid(const valijson::Schema& schema, const json& document, valijson::ValidationResults* results) {
  thread_local valijson::Validator validator(valijson::Validator::kStrongTypes); // it keeps its regular expressions
  return validator.validate(schema, NlohmannJsonAdapter(document), results);
}

// The place that valijson names: "<root>", "[trace]", "[3]".
place place_of(const json& document, const std::vector<std::string>& context) {
  place result;
  const auto* here = &document;
  for (std::size_t i = 1; i < context.size(); ++i) {
    const auto name = context[i].substr(1, context[i].size() - 2);
    if (here->is_array()) {
      result.emplace_back(static_cast<std::size_t>(std::stoul(name)));
      here = &here->at(std::get<std::size_t>(result.back()));
    } else {
      result.emplace_back(name);
      here = &here->at(name);
    }
  }
  return result;
}

bool begins_with(const place& all, const place& front) {
  return front.size() <= all.size() && std::equal(front.begin(), front.end(), all.begin());
}

} // namespace

struct compiled_schema::prepared {
  explicit prepared(const json& source) {
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(NlohmannJsonAdapter(source), schema);
  }
  valijson::Schema schema;
};

compiled_schema::compiled_schema(json schema)
    : source_(std::move(schema)), prepared_(std::make_unique<prepared>(source_)) {}
compiled_schema::~compiled_schema() = default;
compiled_schema::compiled_schema(compiled_schema&&) noexcept = default;
compiled_schema& compiled_schema::operator=(compiled_schema&&) noexcept = default;

bool compiled_schema::holds(const json& document) const { return is_valid(prepared_->schema, document, nullptr); }

std::vector<problem> compiled_schema::problems_of(const json& document, std::size_t at_most) const {
  return holds(document) ? std::vector<problem>() : explain_wrong(document, at_most);
}

std::vector<problem> compiled_schema::explain_wrong(const json& document, std::size_t at_most) const {
  auto problems = explain(document, source_, at_most);
  if (problems.size() <= at_most)
    add_unexplained(document, problems);
  if (problems.empty()) // two who judge disagree: what comes from outside must not end the process
    problems.push_back({{}, "is not what its schema allows", {}});
  return problems;
}

// What is wrong by a keyword without a sentence. About a place where something else is wrong, inside of it or around
// it, valijson may only repeat that.
void compiled_schema::add_unexplained(const json& document, std::vector<problem>& problems) const {
  valijson::ValidationResults results;
  if (is_valid(prepared_->schema, document, &results))
    return;
  std::vector<std::pair<place, std::string>> told;
  for (const auto& each : results)
    told.emplace_back(place_of(document, each.context), each.description);
  std::stable_sort(told.begin(), told.end(),
                   [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); }); // the innermost first
  for (const auto& [where, description] : told) {
    const bool is_explained = std::any_of(problems.begin(), problems.end(), [&where = where](const problem& each) {
      return begins_with(each.where, where) || begins_with(where, each.where);
    });
    if (!is_explained)
      problems.push_back({where, "is not allowed: " + description, {}});
  }
}

} // namespace godwit::io::schemas
