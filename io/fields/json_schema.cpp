#include "io/fields/json_schema.hpp"

#include <utility>

#include <nlohmann/json.hpp>

namespace godwit::io {

using nlohmann::json;

json schema_of_object() { return {{"type", "object"}, {"properties", json::object()}, {"required", json::array()}}; }

void add_property(json& object, std::string_view name, json schema) {
  object["properties"][std::string(name)] = std::move(schema);
  object["required"].push_back(name);
}

json schema_of_list(json of_items) { return {{"type", "array"}, {"items", std::move(of_items)}}; }

json schema_or_null(json schema) { return {{"anyOf", json::array({std::move(schema), schema_of_type("null")})}}; }

json schema_of_type(std::string_view type) { return {{"type", type}}; }

json schema_of_types(std::string_view one, std::string_view other) { return {{"type", json::array({one, other})}}; }

} // namespace godwit::io
