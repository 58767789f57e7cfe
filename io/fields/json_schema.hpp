// The JSON Schema (draft-07) of a struct, made from its field table: what the trace writes into its files, so that a
// viewer knows the fields without godwit's sources. Secrets are left out, as they are from the data. Thread: pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "io/fields/field_table.hpp"
#include "io/fields/forms_fwd.hpp"

namespace godwit::io {

// The parts of a schema; json_schema.cpp.
[[nodiscard]] nlohmann::json schema_of_object();
void add_property(nlohmann::json& object, std::string_view name, nlohmann::json schema);
[[nodiscard]] nlohmann::json schema_of_list(nlohmann::json of_items);
[[nodiscard]] nlohmann::json schema_or_null(nlohmann::json schema);
[[nodiscard]] nlohmann::json schema_of_type(std::string_view type);
[[nodiscard]] nlohmann::json schema_of_types(std::string_view one, std::string_view other);

template <class V>
[[nodiscard]] nlohmann::json json_schema() {
  if constexpr (has_fields<V>) {
    auto result = schema_of_object();
    for_each_field<V>([&]<class Value>(const field_entry<V, Value>& entry) {
      if (!entry.is_secret)
        add_property(result, entry.name, json_schema<Value>());
    });
    return result;
  } else if constexpr (std::is_same_v<V, bool>) {
    return schema_of_type("boolean");
  } else if constexpr (std::is_same_v<V, std::string> || std::is_same_v<V, char> || is_char_array<V>::value) {
    return schema_of_type("string");
  } else if constexpr (named_enum<V>) {
    return schema_of_types("string", "integer"); // a value without a name is written as its number
  } else if constexpr (std::is_floating_point_v<V>) {
    return schema_of_types("number", "null"); // null stands for NaN and infinities
  } else if constexpr (is_optional<V>::value) {
    return schema_or_null(json_schema<typename V::value_type>());
  } else if constexpr (is_vector<V>::value || is_std_array<V>::value) {
    return schema_of_list(json_schema<typename V::value_type>());
  } else {
    return schema_of_type("integer");
  }
}

} // namespace godwit::io
