// Reads the text of a plan file into the items of an upload. What is not understood is refused with line and column,
// and nothing is guessed.
//
// Accepted: the versions 100 (columns and actions of its own), 110 and 120 (the same form); whole numbers with a
// decimal point (16.0); CRLF, a byte order mark in front, a last line without an end, blank lines and comments (from #
// to the end of a line) anywhere; NaN in the parameters and in z, where MAVLink gives it a meaning (leave it to the
// vehicle). The items are numbered as they stand, whatever their indexes are, as ArduPilot's tools do it; a plan with a
// DO_JUMP has to count from 0. Not: an infinity. A file without items is a plan of none. The file does not say which of
// a vehicle's plans it is; every item gets TYPE. Targets stay 0. Degrees and metres as in format.hpp. Errors: as
// values, the first one found. Thread: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_error.hpp"

namespace godwit::io::mavlink {

struct plan_lines {
  std::vector<mission_item_int> items;
  std::vector<std::size_t> lines; // of each item, from 1 on
};

[[nodiscard]] waypoint_result<plan_lines> read_plan_lines(std::string_view text,
                                                          mav_mission_type type = mav_mission_type::mission);

[[nodiscard]] waypoint_result<std::vector<mission_item_int>>
read_waypoints(std::string_view text, mav_mission_type type = mav_mission_type::mission);

// "QGC WPL 100", from before MAVLink 1.0: thirteen columns in another order, and actions of its own.
//
//   INDEX FRAME ACTION ORBIT DIRECTION PARAM1 PARAM2 CURRENT LONGITUDE LATITUDE ALTITUDE YAW AUTOCONTINUE
//
// Thread: constants, pure. Source: pymavlink's mavwp.py.
enum class waypoint_format { version_100, version_110 };

// Where each of waypoint_column stands in a line of version 100.
inline constexpr std::array<std::size_t, waypoint_columns.size()> column_of_100{0, 7, 1, 2, 5, 6, 3, 4, 9, 8, 10, 12};

[[nodiscard]] constexpr std::optional<std::uint16_t> command_of_100(std::uint16_t action) {
  struct row {
    std::uint16_t action;
    mav_cmd command;
  };
  constexpr row rows[] = {
      {2, mav_cmd::nav_takeoff},       {3, mav_cmd::nav_return_to_launch}, {4, mav_cmd::nav_land},
      {24, mav_cmd::nav_takeoff},      {25, mav_cmd::nav_waypoint},        {26, mav_cmd::nav_land},
      {27, mav_cmd::nav_loiter_unlim},
  };
  const auto* const found = std::ranges::find(rows, action, &row::action);
  return found == std::end(rows) ? std::nullopt : std::optional(number(found->command));
}

// The lines of a plan file, without their ends, comments and blanks. Thread: pure.
inline constexpr std::string_view column_blanks = " \t";
inline constexpr char line_comment_mark = '#';
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Gives out a text line by line, without their ends and without a byte order mark in front.
class text_lines {
public:
  explicit text_lines(std::string_view text) : rest_(text) {
    if (rest_.starts_with(byte_order_mark))
      rest_.remove_prefix(byte_order_mark.size());
  }

  [[nodiscard]] std::optional<std::string_view> next() {
    if (rest_.empty())
      return std::nullopt;
    const auto end = std::min(rest_.find('\n'), rest_.size());
    auto line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (line.ends_with('\r'))
      line.remove_suffix(1);
    return line;
  }
  [[nodiscard]] std::size_t number() const { return number_; } // of the last one, from 1 on

private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

// LINE without the blanks and the comment that end it.
[[nodiscard]] inline std::string_view content_of(std::string_view line) {
  line = line.substr(0, line.find(line_comment_mark));
  const auto last = line.find_last_not_of(column_blanks);
  return last == std::string_view::npos ? std::string_view() : line.substr(0, last + 1);
}

// At most one more than MOST: whoever asks sees that there are too many.
[[nodiscard]] inline std::vector<std::string_view> columns_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> result;
  for (auto at = line.find_first_not_of(column_blanks); at != std::string_view::npos && result.size() <= most;
       at = line.find_first_not_of(column_blanks, at)) {
    const auto end = std::min(line.find_first_of(column_blanks, at), line.size());
    result.push_back(line.substr(at, end - at));
    at = end;
  }
  return result;
}

} // namespace godwit::io::mavlink
