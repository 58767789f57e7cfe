#include "actors/domain/mission/convert/convert.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/convert/geojson_export.hpp"
#include "actors/domain/mission/convert/geojson_import.hpp"
#include "actors/domain/mission/convert/kml_import.hpp"
#include "actors/domain/mission/convert/plan_export.hpp"
#include "actors/domain/mission/convert/plan_import.hpp"
#include "actors/domain/mission/convert/waypoints_export.hpp"
#include "actors/domain/mission/convert/waypoints_import.hpp"
#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission {

namespace {

import_result import_json(std::string_view text, const import_options& options) {
  auto result = read<document>(text);
  if (!result)
    return tl::unexpected(conversion_error{std::move(result.error()), {}});
  result->mission_id = options.mission_id.value_or(result->mission_id);
  return finished(*result, {}, options, text);
}

exported export_json(const document& mission) {
  constexpr int indent = 2;
  return {nlohmann::ordered_json::parse(to_text(mission)).dump(indent) + '\n', {}};
}

struct format_row {
  mission_format format;
  import_result (*import)(std::string_view text, const import_options& options);
  exported (*write)(const document& mission); // null: it is only read
};

constexpr std::array formats{
    format_row{mission_format::json, import_json, export_json},
    format_row{mission_format::plan, import_plan, export_plan},
    format_row{mission_format::waypoints, import_waypoints, export_waypoints},
    format_row{mission_format::geojson, import_geojson, export_geojson},
    format_row{mission_format::kml, import_kml, nullptr},
};

const format_row& row_of(mission_format format) {
  return *std::ranges::find(formats, format, &format_row::format); // the table has all of them
}

struct ending_row {
  std::string_view ending;
  mission_format format;
};

constexpr std::array endings{
    ending_row{".json", mission_format::json},
    ending_row{".plan", mission_format::plan},
    ending_row{".waypoints", mission_format::waypoints},
    ending_row{".txt", mission_format::waypoints},
    ending_row{".mission", mission_format::plan},
    ending_row{".fen", mission_format::waypoints},
    ending_row{".ral", mission_format::waypoints},
    ending_row{".geojson", mission_format::geojson},
    ending_row{".kml", mission_format::kml},
};

tl::unexpected<conversion_error> not_written(std::string what, std::string allowed, std::string_view text) {
  return tl::unexpected(
      conversion_error{bounded({document_errc::wrong_form, {{{}, std::move(what), std::move(allowed)}}}, text), {}});
}

// What is written in the form in which it came keeps what the importer does not know. Nothing: it is not read as a
// whole.
std::optional<std::string> whole_plan_again(std::string_view text, import_options options) {
  options.allow_partial = false;
  options.keeps_unknown = true;
  const auto whole = import_plan(text, options);
  return whole ? plan_again(text) : std::nullopt;
}

bool ends_with(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         std::ranges::equal(name.substr(name.size() - ending.size()), ending, [](char found, char wanted) {
           return (found >= 'A' && found <= 'Z' ? found - 'A' + 'a' : found) == wanted;
         });
}

} // namespace

std::optional<mission_format> format_of_name(std::string_view file_name) {
  for (const auto& row : endings)
    if (ends_with(file_name, row.ending))
      return row.format;
  return std::nullopt;
}

import_result import_mission(std::string_view text, mission_format from, const import_options& options) {
  return row_of(from).import(text, options);
}

bool is_written(mission_format format) { return row_of(format).write != nullptr; }

exported export_mission(const document& mission, mission_format to) { return row_of(to).write(mission); }

tl::expected<exported, conversion_error> convert(std::string_view text, mission_format from, mission_format to,
                                                 const import_options& options) {
  if (!is_written(to))
    return not_written("can not be written as KML, which has no items", ".json, .plan, .waypoints or .geojson", text);
  auto reading = options;
  reading.fence_alone = true;
  if (from == mission_format::plan && to == mission_format::plan)
    if (auto again = whole_plan_again(text, reading))
      return exported{*std::move(again), {}};
  auto read_in = import_mission(text, from, reading);
  if (!read_in)
    return tl::unexpected(std::move(read_in.error()));
  const bool is_mission_needed = to == mission_format::json || to == mission_format::geojson;
  if (read_in->mission.items.empty() && is_mission_needed)
    return not_written(why_no_mission(read_in->mission), "a .plan or .waypoints to write it to", text);
  const auto& items = read_in->mission.items;
  if (to == mission_format::waypoints && !items.empty() &&
      std::ranges::all_of(items, [](const item& each) { return std::holds_alternative<survey>(each); }))
    return not_written("has surveys alone, and lines have no patterns: nothing would be left", "a .plan or .json",
                       text);
  auto result = export_mission(read_in->mission, to);
  read_in->losses.add(std::move(result.losses));
  if (!read_in->losses.empty() && !options.allow_partial)
    return tl::unexpected(lossy(std::move(read_in->losses), text));
  return exported{std::move(result.text), std::move(read_in->losses)};
}

} // namespace godwit::mission
