#include "actors/domain/mission/explain.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "actors/domain/mission/text_patterns.hpp"
#include "actors/domain/mission/utf8_length.hpp"
#include "runtime/config/suggest.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

const json& at_or_null(const json& object, std::string_view key) {
  static const json nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

struct type_row {
  std::string_view type; // as the schema calls it
  std::string_view noun; // as people do
  bool (*holds)(const json& value);
};

constexpr std::array type_rows{
    type_row{"integer", "a whole number", [](const json& value) { return value.is_number_integer(); }},
    type_row{"number", "a number", [](const json& value) { return value.is_number(); }},
    type_row{"string", "a text", [](const json& value) { return value.is_string(); }},
    type_row{"boolean", "true or false", [](const json& value) { return value.is_boolean(); }},
    type_row{"array", "a list", [](const json& value) { return value.is_array(); }},
    type_row{"object", "an object", [](const json& value) { return value.is_object(); }},
};

const type_row* type_of(const json& schema) {
  const auto& type = at_or_null(schema, "type");
  const auto found = std::ranges::find_if(type_rows, [&](const auto& row) { return type == row.type; });
  return found == type_rows.end() ? nullptr : &*found;
}

std::string joined(const json& values) {
  std::string result;
  for (std::size_t i = 0; i < values.size(); ++i)
    result += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + values[i].dump();
  return result;
}

std::string found_value(const json& value) {
  if (value.is_string())
    return "is " + in_quotes(value.get_ref<const std::string&>());
  if (value.is_object())
    return "is an object";
  if (value.is_array())
    return "is a list of " + std::to_string(value.size());
  return "is " + value.dump();
}

struct bound_row {
  std::string_view keyword;
  std::string_view words;
  bool (*holds)(const json& value, const json& bound);
};

// In the order in which they are read out.
constexpr std::array bound_rows{
    bound_row{"minimum", " from ", [](const json& value, const json& bound) { return value >= bound; }},
    bound_row{"exclusiveMinimum", " above ", [](const json& value, const json& bound) { return value > bound; }},
    bound_row{"maximum", " up to ", [](const json& value, const json& bound) { return value <= bound; }},
    bound_row{"exclusiveMaximum", " below ", [](const json& value, const json& bound) { return value < bound; }},
};

constexpr std::array size_rows{
    bound_row{"minLength", " of at least ", [](const json& size, const json& bound) { return size >= bound; }},
    bound_row{"maxLength", " of at most ", [](const json& size, const json& bound) { return size <= bound; }},
    bound_row{"minItems", " of at least ", [](const json& size, const json& bound) { return size >= bound; }},
    bound_row{"maxItems", " of at most ", [](const json& size, const json& bound) { return size <= bound; }},
};

template <class Rows>
std::string words_of(const Rows& rows, const json& schema) {
  std::string result;
  for (const auto& row : rows)
    if (const auto& bound = at_or_null(schema, row.keyword); !bound.is_null())
      result += std::string(row.words) + bound.dump();
  return result;
}

template <class Rows>
bool within(const Rows& rows, const json& schema, const json& value) {
  return std::ranges::all_of(rows, [&](const auto& row) {
    const auto& bound = at_or_null(schema, row.keyword);
    return bound.is_null() || row.holds(value, bound);
  });
}

bool matches_pattern(const json& schema, const std::string& text) {
  const auto& pattern = at_or_null(schema, "pattern");
  return !pattern.is_string() || test_of_pattern(pattern.get_ref<const std::string&>())(text);
}

// Whether VALUE itself is allowed, apart from what is in it.
bool is_right_itself(const json& value, const json& schema) {
  if (const auto& values = at_or_null(schema, "enum"); values.is_array())
    return std::ranges::find(values, value) != values.end();
  if (const auto& only = at_or_null(schema, "const"); !only.is_null())
    return value == only;
  if (const auto* type = type_of(schema); type != nullptr && !type->holds(value))
    return false;
  if (value.is_number())
    return within(bound_rows, schema, value);
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    return within(size_rows, schema, utf8_length(text)) && matches_pattern(schema, text);
  }
  return !value.is_array() || within(size_rows, schema, value.size());
}

class explainer {
public:
  void look(const json& value, const json& schema, const std::string& pointer) {
    if (is_full())
      return;
    if (!is_right_itself(value, schema)) {
      problems.push_back({pointer, found_value(value), allowed_by(schema)});
      return;
    }
    const auto before = problems.size();
    if (value.is_object())
      look_into_object(value, schema, pointer);
    if (const auto& each = at_or_null(schema, "items"); value.is_array() && each.is_object())
      for (std::size_t i = 0; i < value.size() && !is_full(); ++i)
        look(value[i], each, pointer_to(pointer, i));
    if (problems.size() == before) // which branch holds is only known when the rest is right
      look_at_branches(value, schema, pointer);
  }

  std::vector<document_problem> problems;

private:
  // Whoever sends a million unknown properties is not told of each.
  [[nodiscard]] bool is_full() const { return problems.size() > max_document_problems; }

  void look_into_object(const json& value, const json& schema, const std::string& pointer) {
    const auto& properties = at_or_null(schema, "properties");
    for (const auto& required : at_or_null(schema, "required"))
      if (const auto& key = required.get_ref<const std::string&>(); !value.contains(key))
        problems.push_back({pointer_to(pointer, key), "is missing",
                            properties.contains(key) ? allowed_by(properties[key]) : std::string()});
    for (const auto& [key, inner] : value.items()) {
      if (is_full())
        return;
      if (properties.contains(key))
        look(inner, properties[key], pointer_to(pointer, key));
      else if (at_or_null(schema, "additionalProperties") == json(false))
        add_unknown(key, properties, pointer);
    }
  }

  void add_unknown(const std::string& key, const json& properties, const std::string& pointer) {
    std::vector<std::string> known;
    std::string list;
    for (const auto& [name, schema] : properties.items()) {
      known.push_back(name);
      list += (list.empty() ? "" : ", ") + name;
    }
    const auto guess = runtime::nearest_word(key, known);
    problems.push_back(
        {pointer_to(pointer, key), "is not known" + (guess ? "; did you mean " + *guess + "?" : std::string()), list});
  }

  void look_at_branches(const json& value, const json& schema, const std::string& pointer) {
    for (const auto& branch : at_or_null(schema, "allOf")) {
      explainer condition;
      condition.look(value, branch.at("if"), pointer);
      if (condition.problems.empty())
        look(value, branch.at("then"), pointer);
    }
  }
};

} // namespace

std::vector<document_problem> explain(const json& document, const json& schema) {
  explainer all;
  all.look(document, schema, {});
  return std::move(all.problems);
}

std::string allowed_by(const json& schema) {
  if (const auto& values = at_or_null(schema, "enum"); values.is_array())
    return joined(values);
  if (const auto& only = at_or_null(schema, "const"); !only.is_null())
    return only.dump();
  if (const auto& title = at_or_null(schema, "title"); title.is_string())
    return title.get<std::string>();
  const auto* type = type_of(schema);
  auto result = type == nullptr ? std::string("a value") : std::string(type->noun);
  result += words_of(bound_rows, schema);
  const auto sizes = words_of(size_rows, schema);
  if (!sizes.empty() && type != nullptr)
    result += sizes + (type->type == "array" ? " entries" : " characters");
  return result;
}

} // namespace godwit::mission
