#include "io/mavlink/waypoint_file/fence_rally_reader.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/waypoint_file/coordinate_text.hpp"
#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::io::mavlink {

namespace {

constexpr std::string_view rally_mark = "RALLY";
constexpr std::size_t fence_columns = 2;
constexpr std::size_t rally_columns = 7;
constexpr std::size_t least_corners = 3;

using line_columns = std::vector<std::string_view>;

tl::unexpected<waypoint_error> wrong_at(waypoint_errc code, std::size_t line, std::string what,
                                        std::string column = {}) {
  return tl::make_unexpected(waypoint_error{code, {}, line, std::move(column), std::move(what)});
}

bool is_number(std::string_view text) {
  double value = 0;
  const auto [stopped, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc{} && stopped == text.data() + text.size() && std::isfinite(value);
}

waypoint_result<mission_item_int> item_at(mav_cmd command, mav_frame frame, std::string_view latitude,
                                          std::string_view longitude, std::size_t line) {
  mission_item_int item;
  item.command = number(command);
  item.frame = number(frame);
  const auto put = [&](axis which, std::string_view text, std::int32_t& to) -> waypoint_result<void> {
    return read_coordinate(coordinate_kind::global, which, text)
        .map([&](std::int32_t value) { to = value; })
        .map_error([&](waypoint_error error) {
          error.line = line;
          error.column = which == axis::x ? "latitude" : "longitude";
          return error;
        });
  };
  if (auto put_x = put(axis::x, latitude, item.x); !put_x)
    return tl::make_unexpected(std::move(put_x.error()));
  if (auto put_y = put(axis::y, longitude, item.y); !put_y)
    return tl::make_unexpected(std::move(put_y.error()));
  return item;
}

waypoint_result<mission_item_int> fence_item(const line_columns& columns, bool is_first, std::size_t line) {
  if (columns.size() != fence_columns)
    return wrong_at(waypoint_errc::wrong_columns, line, "a line of a fence is a latitude and a longitude");
  const auto command = is_first ? mav_cmd::nav_fence_return_point : mav_cmd::nav_fence_polygon_vertex_inclusion;
  return item_at(command, mav_frame::global, columns[0], columns[1], line);
}

waypoint_result<mission_item_int> rally_item(const line_columns& columns, bool /*is_first*/, std::size_t line) {
  if (columns.size() != rally_columns || columns[0] != rally_mark)
    return wrong_at(waypoint_errc::wrong_columns, line,
                    "a rally point is RALLY, latitude, longitude, altitude, break altitude, direction and flags");
  if (!is_number(columns[3]))
    return wrong_at(waypoint_errc::not_a_number, line, in_quotes(columns[3]) + " is not a number", "altitude");
  return item_at(mav_cmd::nav_rally_point, mav_frame::global_relative_alt, columns[1], columns[2], line)
      .map([&](mission_item_int item) {
        std::from_chars(columns[3].data(), columns[3].data() + columns[3].size(), item.z);
        return item;
      });
}

using item_reader = waypoint_result<mission_item_int> (*)(const line_columns& columns, bool is_first, std::size_t line);

waypoint_result<plan_lines> read_lines(std::string_view text, mav_mission_type type, item_reader read) {
  plan_lines result;
  text_lines lines(text);
  while (const auto line = lines.next()) {
    if (line->size() > max_waypoint_line_bytes)
      return wrong_at(waypoint_errc::too_large, lines.number(),
                      "longer than " + std::to_string(max_waypoint_line_bytes) + " characters");
    const auto columns = columns_of(content_of(*line), rally_columns);
    if (columns.empty())
      continue;
    if (result.items.size() == max_waypoint_items)
      return wrong_at(waypoint_errc::too_large, lines.number(),
                      "more than " + std::to_string(max_waypoint_items) + " items");
    auto item = read(columns, result.items.empty(), lines.number());
    if (!item)
      return tl::make_unexpected(std::move(item.error()));
    item->seq = static_cast<std::uint16_t>(result.items.size());
    item->mission_type = static_cast<std::uint8_t>(type);
    item->autocontinue = 1;
    result.items.push_back(*item);
    result.lines.push_back(lines.number());
  }
  return result;
}

bool is_same_place(const mission_item_int& a, const mission_item_int& b) { return a.x == b.x && a.y == b.y; }

} // namespace

std::optional<mav_mission_type> fence_or_rally(std::string_view text) {
  text_lines lines(text);
  while (const auto line = lines.next()) {
    const auto columns = columns_of(content_of(*line), rally_columns);
    if (columns.empty())
      continue;
    if (columns[0] == rally_mark)
      return mav_mission_type::rally;
    const bool is_place = columns.size() == fence_columns && is_number(columns[0]) && is_number(columns[1]);
    return is_place ? std::optional(mav_mission_type::fence) : std::nullopt;
  }
  return std::nullopt;
}

waypoint_result<plan_lines> read_fence_lines(std::string_view text) {
  auto result = read_lines(text, mav_mission_type::fence, fence_item);
  if (!result)
    return result;
  auto& [items, lines] = *result;
  if (items.size() > 2 && is_same_place(items[1], items.back())) { // a closed ring
    items.pop_back();
    lines.pop_back();
  }
  const auto corners = items.empty() ? 0 : items.size() - 1;
  if (corners < least_corners)
    return wrong_at(waypoint_errc::wrong_columns, 0,
                    "a fence is a point of return and a polygon of at least 3 corners; it has " +
                        std::to_string(corners) + " corners");
  for (std::size_t i = 1; i < items.size(); ++i)
    items[i].param1 = static_cast<float>(corners);
  return result;
}

waypoint_result<plan_lines> read_rally_lines(std::string_view text) {
  return read_lines(text, mav_mission_type::rally, rally_item);
}

} // namespace godwit::io::mavlink
