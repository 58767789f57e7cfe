#include "programs/godwitd/option_table.hpp"

#include <algorithm>

#include "runtime/assert.hpp"

namespace godwit::daemon {

const option_row* find_option(std::string_view name) {
  const auto* const found = std::ranges::find(option_rows, name, &option_row::name);
  return found == option_rows.end() ? nullptr : found;
}

std::string variable_of(const option_row& row) {
  std::string result = "GODWIT_";
  for (const char each : row.name)
    result += each == '-' ? '_' : static_cast<char>(each - 'a' + 'A');
  return result;
}

std::string all_names_of(std::string_view option) {
  const auto* const row = find_option(option);
  GODWIT_ASSERT(row != nullptr, "only options of the table are named");
  std::string result = "--" + std::string(option) + " (" + variable_of(*row);
  if (!row->place.empty()) {
    std::string place(row->place.substr(1));
    std::ranges::replace(place, '/', '.');
    result += ", " + place;
  }
  return result + ")";
}

} // namespace godwit::daemon
