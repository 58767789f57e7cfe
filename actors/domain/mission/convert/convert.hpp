// From one file format of missions to another, by way of a mission.
//
//   const auto result = convert(text, mission_format::plan, mission_format::json, {});
//   if (!result) print(result.error().message()); // also what would be lost
//
// Errors: as values; a loss on either way is an error unless the options allow it. Thread: pure.
#pragma once

#include <optional>
#include <string_view>

#include "actors/domain/mission/convert/conversion.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::mission {

enum class mission_format {
  json,      // ours: config/schemas/mission.schema.json
  plan,      // QGroundControl
  waypoints, // QGC WPL 110: QGroundControl, Mission Planner, MAVProxy
  geojson,
  kml // map programs; only read
};

GODWIT_ENUM_NAMES(mission_format, json, plan, waypoints, geojson, kml);

// For sentences.
inline constexpr const char* known_endings =
    ".json (godwit), .plan (QGroundControl), .waypoints and .txt (QGC WPL 110), .geojson, .kml";

// By the ending of a file's name, in any case: .json, .plan or .mission, .waypoints, .txt, .fen or .ral, .geojson,
// .kml.
[[nodiscard]] std::optional<mission_format> format_of_name(std::string_view file_name);

[[nodiscard]] import_result import_mission(std::string_view text, mission_format from,
                                           const import_options& options = {});

[[nodiscard]] bool is_written(mission_format format);

// MISSION keeps all rules, TO is one that is written.
[[nodiscard]] exported export_mission(const document& mission, mission_format to);

[[nodiscard]] tl::expected<exported, conversion_error> convert(std::string_view text, mission_format from,
                                                               mission_format to, const import_options& options = {});

} // namespace godwit::mission
