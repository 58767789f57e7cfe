#include "actors/domain/mission/convert/vehicle_item.hpp"

#include "actors/domain/mission/commands/command_table.hpp"
#include "io/fields/json_text.hpp"

namespace godwit::mission {

std::string command_name(std::uint16_t id) {
  const auto* row = command_of(id);
  return row == nullptr ? "command " + std::to_string(id) : std::string(row->name);
}

std::optional<planned_home> home_at(double latitude, double longitude, double above_sea_m) {
  const bool is_place = std::isfinite(latitude) && std::isfinite(longitude) && (latitude != 0 || longitude != 0);
  if (!is_place)
    return std::nullopt;
  return planned_home{latitude, longitude, std::isfinite(above_sea_m) ? std::optional(above_sea_m) : std::nullopt};
}

std::string number_text(double value) {
  std::string result;
  io::append_json_number(result, value);
  return result;
}

} // namespace godwit::mission
