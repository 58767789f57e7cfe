#include "io/json_schema/explain.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <regex>
#include <string_view>
#include <utility>

#include "io/json_schema/sentence_parts.hpp"

namespace godwit::io::schemas {

namespace {

using nlohmann::json;

constexpr std::size_t longest_value = 80; // bytes of a number in a sentence

const json& at_or_null(const json& object, std::string_view key) {
  static const json nothing;
  if (!object.is_object())
    return nothing;
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
    type_row{"null", "null", [](const json& value) { return value.is_null(); }},
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

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items())
    keys.push_back(key);
  return keys;
}

std::string listed(const std::vector<std::string>& keys) {
  std::string result;
  for (const auto& each : keys)
    result += (result.empty() ? "" : ", ") + each;
  return result;
}

std::string found_value(const json& value) {
  if (value.is_string())
    return "is " + in_quotes(value.get_ref<const std::string&>());
  if (value.is_object())
    return "is an object";
  if (value.is_array())
    return "is a list of " + std::to_string(value.size());
  return "is " + value.dump().substr(0, longest_value);
}

// As doubles: compared as integers, 2^64 - 1 would be -1.
bool is_in_range(const json& schema, double value) {
  const auto holds = [&](std::string_view keyword, auto compare) {
    const auto& bound = at_or_null(schema, keyword);
    return bound.is_null() || compare(value, bound.get<double>());
  };
  return holds("minimum", std::greater_equal<>()) && holds("exclusiveMinimum", std::greater<>()) &&
         holds("maximum", std::less_equal<>()) && holds("exclusiveMaximum", std::less<>());
}

bool has_size(const json& schema, std::size_t size, std::string_view least, std::string_view most) {
  const auto& low = at_or_null(schema, least);
  const auto& high = at_or_null(schema, most);
  return (low.is_null() || size >= low.get<std::size_t>()) && (high.is_null() || size <= high.get<std::size_t>());
}

std::string range_words(const json& schema) {
  const auto& from = at_or_null(schema, "minimum");
  const auto& above = at_or_null(schema, "exclusiveMinimum");
  const auto& to = at_or_null(schema, "maximum");
  const auto& below = at_or_null(schema, "exclusiveMaximum");
  const bool is_open = to.is_null() && below.is_null();
  std::string result = !from.is_null()    ? " from " + from.dump() + (is_open ? " on" : "")
                       : !above.is_null() ? " above " + above.dump()
                                          : std::string();
  if (!to.is_null())
    result += (from.is_null() ? " up to " : " to ") + to.dump();
  return below.is_null() ? result : result + " below " + below.dump();
}

std::string size_words(const json& schema, std::string_view least, std::string_view most, std::string_view noun) {
  const auto& low = at_or_null(schema, least);
  const auto& high = at_or_null(schema, most);
  const std::string unit = " " + std::string(noun);
  if (!low.is_null() && !high.is_null())
    return " of " + low.dump() + " to " + high.dump() + unit;
  if (!low.is_null())
    return " of at least " + low.dump() + unit;
  return high.is_null() ? std::string() : " of up to " + high.dump() + unit;
}

// Compiled once for all of a document. Only asked for texts that are not too long, because std::regex recurses once a
// character.
class pattern_tests {
public:
  bool holds(const json& schema, const std::string& text) {
    const auto& pattern = at_or_null(schema, "pattern");
    if (!pattern.is_string())
      return true;
    const auto& form = pattern.get_ref<const std::string&>();
    auto found = compiled_.find(form);
    if (found == compiled_.end())
      found = compiled_.emplace(form, std::regex(form)).first;
    return std::regex_search(text, found->second);
  }

private:
  std::map<std::string, std::regex> compiled_;
};

// Whether VALUE itself is allowed, apart from what is in it.
bool is_right_itself(const json& value, const json& schema, pattern_tests& patterns) {
  if (const auto& values = at_or_null(schema, "enum"); values.is_array())
    return std::ranges::find(values, value) != values.end();
  if (const auto& only = at_or_null(schema, "const"); !only.is_null())
    return value == only;
  if (const auto* type = type_of(schema); type != nullptr && !type->holds(value))
    return false;
  if (value.is_number())
    return is_in_range(schema, value.get<double>());
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    return has_size(schema, utf8_length(text), "minLength", "maxLength") && patterns.holds(schema, text);
  }
  return true;
}

class explainer {
public:
  explicit explainer(std::size_t at_most, pattern_tests& patterns) : at_most_(at_most), patterns_(&patterns) {}

  void look(const json& value, const json& schema) {
    if (is_full())
      return;
    if (!is_right_itself(value, schema, *patterns_)) {
      problems.push_back({here_, found_value(value), allowed_by(schema)});
      return;
    }
    const auto before = problems.size();
    if (value.is_array() && !has_size(schema, value.size(), "minItems", "maxItems"))
      problems.push_back({here_, found_value(value), allowed_by(schema)}); // and what is in it is told as well
    if (value.is_object())
      look_into_object(value, schema);
    if (const auto& each = at_or_null(schema, "items"); value.is_array() && each.is_object())
      for (std::size_t i = 0; i < value.size() && !is_full(); ++i)
        look_at(i, value[i], each);
    if (problems.size() == before) // which branch holds is only known when the rest is right
      look_at_branches(value, schema);
  }

  std::vector<problem> problems;

private:
  // Whoever sends a million unknown properties is not told of each.
  [[nodiscard]] bool is_full() const { return problems.size() > at_most_; }

  void add(const std::string& key, std::string what, std::string allowed) {
    auto where = here_;
    where.emplace_back(key);
    problems.push_back({std::move(where), std::move(what), std::move(allowed)});
  }

  void look_at(step to, const json& value, const json& schema) {
    here_.push_back(std::move(to));
    look(value, schema);
    here_.pop_back();
  }

  void look_into_object(const json& value, const json& schema) {
    const auto& properties = at_or_null(schema, "properties");
    for (const auto& required : at_or_null(schema, "required"))
      if (const auto& key = required.get_ref<const std::string&>(); !value.contains(key))
        add(key, "is missing", allowed_by(at_or_null(properties, key)));
    for (const auto& [key, inner] : value.items())
      if (const auto& known = at_or_null(properties, key); !known.is_null())
        look_at(key, inner, known);
    if (at_or_null(schema, "additionalProperties") == json(false))
      add_unknown(value, properties);
  }

  void add_unknown(const json& value, const json& properties) {
    const auto known = keys_of(properties);
    for (const auto& [key, inner] : value.items()) {
      if (is_full())
        return;
      if (properties.contains(key))
        continue;
      const auto guess = nearest_word(key, known);
      add(key, "is not known" + (guess ? "; did you mean " + *guess + "?" : std::string()), listed(known));
    }
  }

  void look_at_branches(const json& value, const json& schema) {
    for (const auto& branch : at_or_null(schema, "allOf")) {
      if (!branch.contains("if") || !branch.contains("then"))
        continue;
      explainer condition(0, *patterns_);
      condition.look(value, branch["if"]);
      if (condition.problems.empty())
        look(value, branch["then"]);
    }
  }

  std::size_t at_most_;
  pattern_tests* patterns_;
  place here_;
};

} // namespace

std::vector<problem> explain(const json& document, const json& schema, std::size_t at_most) {
  pattern_tests patterns;
  explainer all(at_most, patterns);
  all.look(document, schema);
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
  if (type == nullptr)
    return "a value" + range_words(schema);
  auto result = std::string(type->noun) + range_words(schema);
  if (type->type == "string")
    result += size_words(schema, "minLength", "maxLength", "characters");
  if (type->type == "array")
    result += size_words(schema, "minItems", "maxItems", "entries");
  if (const auto& pattern = at_or_null(schema, "pattern"); pattern.is_string())
    result += " that matches " + pattern.get_ref<const std::string&>();
  if (const auto& properties = at_or_null(schema, "properties"); properties.is_object())
    result += " with " + listed(keys_of(properties));
  return result;
}

} // namespace godwit::io::schemas
