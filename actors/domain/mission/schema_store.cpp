#include "actors/domain/mission/schema_store.hpp"

#include <functional>
#include <map>
#include <string>

#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;
using schema_map = std::map<std::string, json, std::less<>>;

constexpr std::string_view file_ending = ".schema.json";

schema_map parse_all() {
  schema_map parsed;
  for (const auto& [name, text] : embedded_schemas()) {
    auto schema = json::parse(text, nullptr, false);
    GODWIT_ASSERT(!schema.is_discarded(), "config/schemas/" + std::string(name) + " is JSON");
    parsed.emplace(name, std::move(schema));
  }
  return parsed;
}

// "common.schema.json#/definitions/uuid", "item.schema.json" or "#/definitions/takeoff" in the file FILE. A cycle of
// references would not end; the schemas have none, as their test shows.
json resolved(const schema_map& parsed, const std::string& file, const json& schema) {
  if (schema.is_array()) {
    auto all = json::array();
    for (const auto& each : schema)
      all.push_back(resolved(parsed, file, each));
    return all;
  }
  if (!schema.is_object())
    return schema;
  if (const auto reference = schema.find("$ref"); reference != schema.end()) {
    const auto& text = reference->get_ref<const std::string&>();
    const auto hash = text.find('#');
    auto target = text.substr(0, hash);
    target = target.empty() ? file : target.substr(0, target.size() - file_ending.size());
    const auto found = parsed.find(target);
    GODWIT_ASSERT(found != parsed.end(), "a schema refers to one that is there: " + text);
    const auto place = hash == std::string::npos ? json::json_pointer() : json::json_pointer(text.substr(hash + 1));
    return resolved(parsed, target, found->second.at(place));
  }
  auto all = json::object();
  for (const auto& [key, value] : schema.items())
    if (key != "definitions")
      all[key] = resolved(parsed, file, value);
  return all;
}

schema_map resolve_all() {
  const auto parsed = parse_all();
  schema_map result;
  for (const auto& [name, schema] : parsed)
    result.emplace(name, resolved(parsed, name, schema));
  return result;
}

} // namespace

const json& schema_named(std::string_view name) {
  static const schema_map all = resolve_all();
  const auto found = all.find(name);
  GODWIT_ASSERT(found != all.end(), "there is a schema " + std::string(name));
  return found->second;
}

} // namespace godwit::mission
