// The JSON Schema (draft-07) of a struct, made from its field table: what the trace writes into its files, so that a
// viewer knows the fields without godwit's sources. Secrets are left out, as they are from the data. Thread: pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "io/fields/field_table.hpp"

namespace godwit::io {

template <class V>
[[nodiscard]] nlohmann::json json_schema() {
  using nlohmann::json;
  if constexpr (has_fields<V>) {
    json properties = json::object();
    json required = json::array();
    for_each_field<V>([&]<class Value>(const field_entry<V, Value>& entry) {
      if (entry.is_secret)
        return;
      properties[std::string(entry.name)] = json_schema<Value>();
      required.push_back(entry.name);
    });
    return {{"type", "object"}, {"properties", properties}, {"required", required}};
  } else if constexpr (std::is_same_v<V, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_same_v<V, std::string> || std::is_same_v<V, char> || is_char_array<V>::value) {
    return {{"type", "string"}};
  } else if constexpr (named_enum<V>) {
    return {{"type", json::array({"string", "integer"})}}; // a value without a name is written as its number
  } else if constexpr (std::is_floating_point_v<V>) {
    return {{"type", json::array({"number", "null"})}}; // null stands for NaN and infinities
  } else if constexpr (is_optional<V>::value) {
    return {{"anyOf", json::array({json_schema<typename V::value_type>(), json{{"type", "null"}}})}};
  } else if constexpr (is_vector<V>::value || is_std_array<V>::value) {
    return {{"type", "array"}, {"items", json_schema<typename V::value_type>()}};
  } else {
    return {{"type", "integer"}};
  }
}

} // namespace godwit::io
