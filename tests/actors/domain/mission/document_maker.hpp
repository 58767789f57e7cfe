// Documents made from a schema and a seed, and damaged: some valid, some wrong in one place, some beyond recognition.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace godwit::mission {

class document_maker {
public:
  using json = nlohmann::json;

  explicit document_maker(std::uint64_t seed) : random_(seed) {}

  // Most of these are valid by SCHEMA; numbers stand on their bounds, and sometimes just beyond.
  json document(const json& schema) {
    if (schema.contains("allOf"))
      return document(pick(schema["allOf"]).at("then"));
    if (schema.contains("enum"))
      return pick(schema["enum"]);
    if (schema.contains("const"))
      return schema["const"];
    const auto type = schema.value("type", "");
    if (type == "object")
      return object(schema);
    if (type == "array")
      return list(schema);
    if (type == "string")
      return text(schema);
    if (type == "boolean")
      return one_in(2);
    return number(schema, type == "integer");
  }

  // One place is another than before.
  void damage(json& value) {
    json* place = &value;
    while (place->is_structured() && !place->empty() && !one_in(4))
      place = &*std::next(place->begin(), whole(0, static_cast<int>(place->size()) - 1));
    if (place->is_object() && !place->empty() && one_in(2))
      place->erase(std::next(place->begin(), whole(0, static_cast<int>(place->size()) - 1)));
    else if (place->is_object())
      (*place)[one_in(2) ? "unknown" : "id"] = anything();
    else if (place->is_string() && one_in(2))
      damage_text(place->get_ref<std::string&>());
    else
      *place = anything();
  }

  bool one_in(int count) { return whole(1, count) == 1; }
  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

private:
  json pick(const json& values) {
    return values.at(static_cast<std::size_t>(whole(0, static_cast<int>(values.size()) - 1)));
  }

  json object(const json& schema) {
    auto result = json::object();
    const auto required = schema.value("required", std::vector<std::string>());
    for (const auto& [key, inner] : schema["properties"].items())
      if (std::ranges::find(required, key) != required.end() || one_in(2))
        result[key] = document(inner);
    return result;
  }

  json list(const json& schema) {
    auto result = json::array();
    for (int i = schema.value("minItems", 0) + whole(0, 2); i > 0; --i)
      result.push_back(document(schema["items"]));
    return result;
  }

  json number(const json& schema, bool is_whole) {
    const double least = schema.value("minimum", schema.value("exclusiveMinimum", -1e6));
    const double most = schema.value("maximum", schema.value("exclusiveMaximum", 1e6));
    const double bounds[] = {least, most, least - 1, most + 1, std::nextafter(least, most), std::nextafter(most, least),
                             0};
    const auto value = one_in(8) ? bounds[whole(0, 6)] : std::uniform_real_distribution<double>(least, most)(random_);
    return is_whole ? json(static_cast<std::int64_t>(value)) : json(value);
  }

  json text(const json& schema) {
    static const std::vector<std::string> samples{"7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42",
                                                  "2026-05-04T10:15:30Z",
                                                  "2026-05-04T10:15:30.123456789Z",
                                                  "1.0.0",
                                                  "10.200.999999",
                                                  "32TNS1234567890",
                                                  "ZAH",
                                                  "4QFJ"};
    const auto pattern = schema.value("pattern", "");
    const auto starts_with = [&](const char* start) { return pattern.starts_with(start); };
    if (starts_with("^[0-9a-f]{8}"))
      return samples[0];
    if (starts_with("^[0-9]{4}"))
      return samples[static_cast<std::size_t>(whole(1, 2))];
    if (starts_with("^(0|"))
      return samples[static_cast<std::size_t>(whole(3, 4))];
    if (starts_with("^([0-9]{1,2}"))
      return samples[static_cast<std::size_t>(whole(5, 7))];
    std::string result;
    for (int i = schema.value("minLength", 0) + whole(0, 3); i > 0; --i)
      result += one_in(4) ? "ж" : "a";
    return result;
  }

  void damage_text(std::string& text) {
    static const std::string letters = "0f9gGZI.-:TzAж\n";
    const auto at = static_cast<std::size_t>(whole(0, static_cast<int>(text.size())));
    const auto letter = letters.substr(static_cast<std::size_t>(whole(0, 12)), 1);
    if (one_in(3) || at == text.size())
      text.insert(at, letter);
    else if (one_in(2))
      text.erase(at, 1);
    else
      text.replace(at, 1, letter);
    if (json(text).dump(-1, ' ', false, json::error_handler_t::replace) !=
        json(text).dump(-1, ' ', false, json::error_handler_t::ignore))
      text = "ж"; // a character was cut in two, and a parser lets no such thing in
  }

  json anything() {
    const json values[] = {nullptr,
                           true,
                           0,
                           -1,
                           1,
                           0.5,
                           3.0,
                           1e300,
                           4294967296,
                           "",
                           "x",
                           std::string(70, 'x'),
                           std::string(36, 'a'),
                           json::array(),
                           json::array({1, nullptr}),
                           json::object(),
                           json{{"id", 1}}};
    return values[whole(0, static_cast<int>(std::size(values)) - 1)];
  }

  std::mt19937_64 random_;
};

} // namespace godwit::mission
