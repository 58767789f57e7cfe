#include "runtime/config/schema.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "io/json_schema/sentence_parts.hpp"

namespace godwit::runtime {

namespace {

using nlohmann::json;
namespace json_schema = io::schemas;

std::string path_of(const json_schema::place& where) {
  std::string path;
  for (const auto& each : where)
    if (const auto* key = std::get_if<std::string>(&each))
      path = path_to_key(path, *key);
    else
      path = path_to_item(path, std::get<std::size_t>(each));
  return path;
}

} // namespace

std::vector<config_problem> violations(const json& document, const json_schema::compiled_schema& schema) {
  constexpr auto all = std::numeric_limits<std::size_t>::max(); // max_config_bytes bounds them
  std::vector<config_problem> problems;
  for (auto& each : schema.problems_of(document, all))
    problems.push_back({path_of(each.where), std::move(each.what), std::move(each.allowed)});
  return problems;
}

void fill_defaults(json& document, const json& schema) {
  if (!document.is_object())
    return;
  const auto properties = schema.value("properties", json::object());
  for (const auto& item : properties.items()) {
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

namespace {

bool is_plain(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') || character == '_' || character == '-' || character == '$';
}

} // namespace

std::string readable_key(std::string_view key) {
  if (!key.empty() && key.size() <= io::schemas::longest_quote && std::all_of(key.begin(), key.end(), is_plain))
    return std::string(key);
  return io::schemas::in_quotes(key);
}

std::string path_to_key(std::string_view parent, std::string_view key) {
  return parent.empty() ? readable_key(key) : std::string(parent) + "." + readable_key(key);
}

std::string path_to_item(std::string_view parent, std::size_t index) {
  return std::string(parent) + "[" + std::to_string(index) + "]";
}

} // namespace godwit::runtime
