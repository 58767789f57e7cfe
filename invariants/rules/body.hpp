// What stands in the recorded body of a message. What is not there, or of another type, is nothing. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::invariants {

[[nodiscard]] inline std::optional<std::uint64_t> number(const nlohmann::json& of, const char* name) {
  const auto found = of.find(name);
  return found != of.end() && found->is_number_unsigned() ? std::optional(found->get<std::uint64_t>()) : std::nullopt;
}

[[nodiscard]] inline std::string text(const nlohmann::json& of, const char* name) {
  const auto found = of.find(name);
  return found != of.end() && found->is_string() ? found->get<std::string>() : std::string();
}

[[nodiscard]] inline bool flag(const nlohmann::json& of, const char* name) {
  const auto found = of.find(name);
  return found != of.end() && *found == true;
}

[[nodiscard]] inline nlohmann::json object_in(const runtime::delivery& each) {
  auto result = nlohmann::json::parse(each.body, nullptr, false);
  return result.is_object() ? result : nlohmann::json::object();
}

// A member of that; nothing is in it where it is none.
[[nodiscard]] inline nlohmann::json object_in(const runtime::delivery& each, const char* member) {
  const auto whole = object_in(each);
  const auto found = whole.find(member);
  return found != whole.end() && found->is_object() ? *found : nlohmann::json::object();
}

} // namespace godwit::invariants
