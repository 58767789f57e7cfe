#include "actors/scan_controller/settings.hpp"

#include <algorithm>

namespace godwit::scan_controller {
namespace {

// As many as the map takes of a pass, and as long.
constexpr std::size_t max_looked_for = 64;
constexpr std::size_t max_class_group_bytes = 64;

} // namespace

std::optional<std::string> objection_to(const settings& configured) {
  const auto& names = configured.looks_for;
  if (names.size() > max_looked_for)
    return "more than " + std::to_string(max_looked_for) + " class groups";
  const auto too_long =
      std::ranges::find_if(names, [](const std::string& each) { return each.size() > max_class_group_bytes; });
  if (too_long != names.end())
    return "a class group has at most " + std::to_string(max_class_group_bytes) + " bytes: " + *too_long;
  return std::nullopt;
}

} // namespace godwit::scan_controller
