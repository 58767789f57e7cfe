// Reading the JSON of a ground station's plan: what is not there or of the wrong type is a problem that is kept, and
// reading goes on with a default, so that one look finds all that is wrong.
//
// Properties that the importer does not know are losses: a newer ground station may mean something by them. Thread: one
// owner.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/error.hpp"
#include "messages/mission/place.hpp"

namespace godwit::mission {

inline constexpr std::size_t max_plan_list = 20'000; // entries of one list: twice the items of a mission

// An object or list of the plan and where it stands.
struct plan_node {
  const nlohmann::json* value; // JSON's null when it is not there
  std::string pointer;
  std::optional<std::size_t> item{}; // of the mission, when it is within one

  [[nodiscard]] bool has(std::string_view key) const { return value->is_object() && value->contains(key); }
};

class plan_source {
public:
  explicit plan_source(loss_list& found, bool keeps_unknown = false) : losses(found), keeps_unknown_(keeps_unknown) {}

  [[nodiscard]] plan_node object(const plan_node& parent, std::string_view key);
  [[nodiscard]] std::vector<plan_node> list(const plan_node& parent, std::string_view key);
  [[nodiscard]] double number(const plan_node& parent, std::string_view key);
  [[nodiscard]] std::int64_t integer(const plan_node& parent, std::string_view key);
  [[nodiscard]] std::string text(const plan_node& parent, std::string_view key);
  [[nodiscard]] bool flag(const plan_node& parent, std::string_view key);
  [[nodiscard]] bool flag_or(const plan_node& parent, std::string_view key, bool when_absent);
  [[nodiscard]] double number_or(const plan_node& parent, std::string_view key, double when_absent);
  // [latitude, longitude] or [latitude, longitude, altitude]; what is null is NaN.
  [[nodiscard]] std::array<double, 3> place(const plan_node& parent, std::string_view key);
  // A corner at the end that repeats the first is none.
  [[nodiscard]] std::vector<vertex> corners(const plan_node& parent, std::string_view key);
  [[nodiscard]] std::array<double, 3> numbers(const plan_node& list_of_2_or_3);

  void wrong(const plan_node& where, std::string what, std::string allowed);
  void lose_unknown(const plan_node& where, std::initializer_list<std::string_view> known);

  std::vector<document_problem> problems; // one more than max_document_problems at most
  loss_list& losses;

private:
  bool keeps_unknown_; // what is not known is no loss
  [[nodiscard]] const nlohmann::json& at(const plan_node& parent, std::string_view key) const;
  void wrong_at(const plan_node& parent, std::string_view key, std::string allowed);
};

} // namespace godwit::mission
