#include "actors/domain/mission/convert/plan_source.hpp"

#include <algorithm>
#include <cmath>

#include "actors/domain/mission/convert/vehicle_item.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

const json nothing_there;

constexpr double max_plan_integer = 65'535;

// null and NaN are both "not given".
double number_of(const json& value) { return value.is_number() ? value.get<double>() : not_given; }

} // namespace

const json& plan_source::at(const plan_node& parent, std::string_view key) const {
  return parent.has(key) ? (*parent.value)[std::string(key)] : nothing_there;
}

void plan_source::wrong(const plan_node& where, std::string what, std::string allowed) {
  if (problems.size() <= max_document_problems)
    problems.push_back({where.pointer, std::move(what), std::move(allowed)});
}

void plan_source::wrong_at(const plan_node& parent, std::string_view key, std::string allowed) {
  wrong({&nothing_there, pointer_to(parent.pointer, key)}, parent.has(key) ? "is of another type" : "is missing",
        std::move(allowed));
}

plan_node plan_source::object(const plan_node& parent, std::string_view key) {
  const auto& found = at(parent, key);
  if (!found.is_object())
    wrong_at(parent, key, "an object");
  return {&found, pointer_to(parent.pointer, key), parent.item};
}

std::vector<plan_node> plan_source::list(const plan_node& parent, std::string_view key) {
  const auto& found = at(parent, key);
  if (!found.is_array())
    wrong_at(parent, key, "a list");
  std::vector<plan_node> result;
  if (found.is_array() && found.size() > max_plan_list) {
    wrong({&found, pointer_to(parent.pointer, key)}, "is a list of " + std::to_string(found.size()),
          "up to " + std::to_string(max_plan_list));
    return result;
  }
  for (std::size_t i = 0; found.is_array() && i < found.size(); ++i)
    result.push_back({&found[i], pointer_to(pointer_to(parent.pointer, key), i), parent.item});
  return result;
}

double plan_source::number(const plan_node& parent, std::string_view key) {
  const auto& found = at(parent, key);
  if (!found.is_number())
    wrong_at(parent, key, "a number");
  return found.is_number() ? found.get<double>() : 0;
}

double plan_source::number_or(const plan_node& parent, std::string_view key, double when_absent) {
  return parent.has(key) ? number(parent, key) : when_absent;
}

std::int64_t plan_source::integer(const plan_node& parent, std::string_view key) {
  const auto value = number_of(at(parent, key));
  const bool is_whole = std::abs(value) <= max_plan_integer && value == std::trunc(value);
  if (!is_whole)
    wrong_at(parent, key, "a whole number up to 65535");
  return is_whole ? static_cast<std::int64_t>(value) : 0;
}

std::string plan_source::text(const plan_node& parent, std::string_view key) {
  const auto& found = at(parent, key);
  if (!found.is_string())
    wrong_at(parent, key, "a text");
  return found.is_string() ? found.get<std::string>() : std::string();
}

bool plan_source::flag(const plan_node& parent, std::string_view key) {
  const auto& found = at(parent, key);
  if (!found.is_boolean())
    wrong_at(parent, key, "true or false");
  return found.is_boolean() && found.get<bool>();
}

bool plan_source::flag_or(const plan_node& parent, std::string_view key, bool when_absent) {
  return parent.has(key) ? flag(parent, key) : when_absent;
}

std::array<double, 3> plan_source::numbers(const plan_node& list_of_2_or_3) {
  const auto& found = *list_of_2_or_3.value;
  std::array<double, 3> result{not_given, not_given, not_given};
  const bool is_list = found.is_array() && (found.size() == 2 || found.size() == 3) &&
                       std::ranges::all_of(found, [](const json& each) { return each.is_number() || each.is_null(); });
  if (!is_list)
    wrong(list_of_2_or_3, "is no place", "[latitude, longitude] or [latitude, longitude, altitude]");
  for (std::size_t i = 0; is_list && i < found.size(); ++i)
    result.at(i) = number_of(found[i]);
  return result;
}

std::array<double, 3> plan_source::place(const plan_node& parent, std::string_view key) {
  if (!parent.has(key)) {
    wrong_at(parent, key, "[latitude, longitude] or [latitude, longitude, altitude]");
    return {not_given, not_given, not_given};
  }
  return numbers({&at(parent, key), pointer_to(parent.pointer, key), parent.item});
}

std::vector<vertex> plan_source::corners(const plan_node& parent, std::string_view key) {
  std::vector<vertex> result;
  for (const auto& corner : list(parent, key)) {
    const auto place = numbers(corner);
    result.push_back({place[0], place[1]});
  }
  if (result.size() > 1 && result.front() == result.back()) // a closed ring, as maps draw it
    result.pop_back();
  return result;
}

void plan_source::lose_unknown(const plan_node& where, std::initializer_list<std::string_view> known) {
  if (keeps_unknown_ || !where.value->is_object())
    return;
  for (const auto& [key, value] : where.value->items())
    if (std::ranges::find(known, std::string_view(key)) == known.end())
      losses.add({where.item, "property " + in_quotes(pointer_to(where.pointer, key)), "the importer does not know it",
                  "left out"});
}

} // namespace godwit::mission
