#include "runtime/config/schema.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "runtime/assert.hpp"
#include "runtime/config/document_path.hpp"
#include "runtime/config/suggest.hpp"

namespace godwit::runtime {

namespace {

using nlohmann::json;
using valijson::adapters::NlohmannJsonAdapter;

constexpr std::size_t longest_value = 80; // bytes of a value in a message

const json& at_or_null(const json& object, std::string_view key) {
  static const json nothing;
  if (!object.is_object())
    return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

std::string readable(const json& value) {
  if (value.is_string())
    return readable_text(value.get_ref<const std::string&>());
  if (value.is_object())
    return "an object";
  if (value.is_array())
    return "a list of " + std::to_string(value.size());
  return value.dump().substr(0, longest_value);
}

std::string joined(const json& values, std::string_view last) {
  std::string result;
  for (std::size_t index = 0; index < values.size(); ++index) {
    if (index != 0)
      result += index + 1 == values.size() ? std::string(last) : ", ";
    result += values[index].dump();
  }
  return result;
}

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items())
    keys.push_back(item.key());
  return keys;
}

struct type_row {
  std::string_view type; // as the schema calls it
  std::string_view noun; // as people do
  bool (*holds)(const json& value);
};

constexpr std::array type_rows{
    type_row{"integer", "an integer", [](const json& value) { return value.is_number_integer(); }},
    type_row{"number", "a number", [](const json& value) { return value.is_number(); }},
    type_row{"string", "a text", [](const json& value) { return value.is_string(); }},
    type_row{"boolean", "true or false", [](const json& value) { return value.is_boolean(); }},
    type_row{"array", "a list", [](const json& value) { return value.is_array(); }},
    type_row{"object", "an object", [](const json& value) { return value.is_object(); }},
    type_row{"null", "null", [](const json& value) { return value.is_null(); }},
};

// The row of the type that `schema` names; null when it names none or several.
const type_row* type_of(const json& schema) {
  const auto& type = at_or_null(schema, "type");
  const auto found =
      std::find_if(type_rows.begin(), type_rows.end(), [&](const auto& row) { return type == row.type; });
  return found == type_rows.end() ? nullptr : &*found;
}

std::string range_of(const json& schema) {
  const auto& least = at_or_null(schema, "minimum");
  const auto& most = at_or_null(schema, "maximum");
  if (!least.is_null() && !most.is_null())
    return " from " + least.dump() + " to " + most.dump();
  if (!least.is_null())
    return " from " + least.dump() + " on";
  if (!most.is_null())
    return " up to " + most.dump();
  return {};
}

std::string length_of(const json& schema) {
  std::string result;
  if (const auto& least = at_or_null(schema, "minLength"); !least.is_null())
    result += " of at least " + least.dump() + " characters";
  if (const auto& most = at_or_null(schema, "maxLength"); !most.is_null())
    result += std::string(result.empty() ? " of" : " and") + " at most " + most.dump() + " characters";
  return result;
}

// The place in the document that valijson names: "<root>", "[trace]", "[total_mib]".
struct place {
  std::string path;
  const json* value;
  const json* schema; // JSON's null when the schema says nothing about it in `properties` or `items`
};

place find_place(const json& document, const json& schema, const std::vector<std::string>& context) {
  place here{{}, &document, &schema};
  for (std::size_t index = 1; index < context.size(); ++index) {
    const auto name = std::string_view(context[index]).substr(1, context[index].size() - 2);
    if (here.value->is_array()) {
      const auto item = std::stoul(std::string(name));
      here.path = path_to_item(here.path, item);
      here.value = &here.value->at(item);
      here.schema = &at_or_null(*here.schema, "items");
    } else {
      here.path = path_to_key(here.path, name);
      here.value = &here.value->at(std::string(name));
      here.schema = &at_or_null(at_or_null(*here.schema, "properties"), name);
    }
  }
  return here;
}

// What is wrong with the keys of an object, apart from the values behind them.
void add_key_problems(const place& here, std::vector<config_problem>& problems) {
  const auto& properties = at_or_null(*here.schema, "properties");
  for (const auto& required : at_or_null(*here.schema, "required")) {
    const auto& key = required.get_ref<const std::string&>();
    if (!here.value->contains(key))
      problems.push_back({path_to_key(here.path, key), "is missing", allowed_by(at_or_null(properties, key))});
  }
  if (at_or_null(*here.schema, "additionalProperties") != json(false))
    return;
  const auto known = keys_of(properties);
  for (const auto& item : here.value->items()) {
    if (properties.contains(item.key()))
      continue;
    const auto guess = nearest_word(item.key(), known);
    problems.push_back({path_to_key(here.path, item.key()),
                        "is not known" + (guess ? "; did you mean " + *guess + "?" : ""), joined(json(known), ", ")});
  }
}

// Whether the value itself breaks the rules at its place. For an object or list of the right type valijson may only
// repeat that something inside it is wrong.
bool is_wrong_itself(const place& here) {
  const auto* type = type_of(*here.schema);
  return !here.value->is_structured() || (type != nullptr && !type->holds(*here.value));
}

// Adds what is wrong at this very place and returns whether there was anything.
bool explain(const place& here, std::vector<config_problem>& problems) {
  const auto before = problems.size();
  if (here.schema->is_object()) {
    if (is_wrong_itself(here))
      problems.push_back({here.path, "is " + readable(*here.value), allowed_by(*here.schema)});
    else if (here.value->is_object())
      add_key_problems(here, problems);
  }
  return problems.size() != before;
}

bool contains_another(const std::vector<std::string>& outer, const std::set<std::vector<std::string>>& places) {
  return std::any_of(places.begin(), places.end(), [&](const auto& inner) {
    return inner.size() > outer.size() && std::equal(outer.begin(), outer.end(), inner.begin());
  });
}

} // namespace

std::string allowed_by(const json& schema) {
  if (const auto& values = at_or_null(schema, "enum"); values.is_array())
    return joined(values, " or ");
  if (const auto& value = at_or_null(schema, "const"); !value.is_null())
    return value.dump();
  const auto* type = type_of(schema);
  std::string result(type == nullptr ? "a value" : type->noun);
  result += range_of(schema) + length_of(schema);
  if (const auto& pattern = at_or_null(schema, "pattern"); pattern.is_string())
    result += " that matches " + pattern.get_ref<const std::string&>();
  if (const auto& properties = at_or_null(schema, "properties"); properties.is_object())
    result += " with " + joined(json(keys_of(properties)), ", ");
  return result;
}

std::vector<config_problem> violations(const json& document, const json& schema) {
  valijson::Schema compiled;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(NlohmannJsonAdapter(schema), compiled);
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(compiled, NlohmannJsonAdapter(document), &results))
    return {};

  std::set<std::vector<std::string>> places;
  for (const auto& result : results)
    places.insert(result.context);
  std::vector<config_problem> problems;
  std::set<std::vector<std::string>> explained;
  for (const auto& result : results) {
    if (!explained.insert(result.context).second)
      continue;
    const auto here = find_place(document, schema, result.context);
    if (!explain(here, problems) && !contains_another(result.context, places))
      problems.push_back({here.path, "is not allowed: " + result.description, {}});
  }
  GODWIT_ASSERT(!problems.empty(), "a document that is not valid has a problem");
  return problems;
}

void fill_defaults(json& document, const json& schema) {
  if (!document.is_object())
    return;
  for (const auto& item : at_or_null(schema, "properties").items()) {
    const auto& inner = item.value();
    if (!document.contains(item.key())) {
      if (inner.contains("default"))
        document[item.key()] = inner["default"];
      else if (inner.contains("properties"))
        document[item.key()] = json::object();
      else
        continue;
    }
    fill_defaults(document[item.key()], inner);
  }
}

} // namespace godwit::runtime
