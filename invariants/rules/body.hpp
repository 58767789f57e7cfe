// What stands in the recorded body of a message. What is not there, or of another type, is nothing. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// Message types by their number in a name_table, so that millions of deliveries are told apart without comparing text.
// Thread: one at a time.

// Whether a number is the one of NAME.
class known_name {
public:
  explicit known_name(std::string_view name) : name_(name) {}

  [[nodiscard]] bool is(std::uint32_t number, const runtime::name_table& names) {
    if (number_ != unknown)
      return number == number_;
    if (known_no_.size() <= number)
      known_no_.resize(number + 1, false);
    if (known_no_[number])
      return false;
    if (names.name(number) == name_) {
      number_ = number;
      return true;
    }
    known_no_[number] = true;
    return false;
  }

private:
  static constexpr std::uint32_t unknown = UINT32_MAX;
  std::string_view name_;
  std::uint32_t number_ = unknown;
  std::vector<bool> known_no_; // looked at, and of another name
};

} // namespace godwit::invariants
