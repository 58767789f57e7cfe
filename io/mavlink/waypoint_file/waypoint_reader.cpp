#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/waypoint_file/coordinate_text.hpp"
#include "io/mavlink/waypoint_file/format.hpp"

namespace godwit::io::mavlink {

namespace {

using columns = std::array<std::string_view, waypoint_columns.size()>;

template <class T>
using column_result = tl::expected<T, waypoint_error>; // the line is filled in by the reader

tl::unexpected<waypoint_error> wrong(waypoint_errc code, std::string what, std::string_view column = {}) {
  return tl::make_unexpected(waypoint_error{code, {}, 0, std::string(column), std::move(what)});
}

bool is_nan_text(std::string_view text) {
  constexpr auto is_letter = [](char each, char lower, char upper) { return each == lower || each == upper; };
  return text.size() == 3 && is_letter(text[0], 'n', 'N') && is_letter(text[1], 'a', 'A') &&
         is_letter(text[2], 'n', 'N');
}

// "16" of "16.0", which some programs write; all of TEXT if it is no such number.
std::string_view whole_part(std::string_view text) {
  const auto point = text.find('.');
  const bool is_whole = point != std::string_view::npos && point != 0 && point + 1 < text.size() &&
                        text.find_first_not_of('0', point + 1) == std::string_view::npos;
  return is_whole ? text.substr(0, point) : text;
}

// The parts of one line; each column has a name.
class item_line {
public:
  explicit item_line(const columns& parts) : parts_(parts) {}

  template <class T>
  [[nodiscard]] column_result<T> whole(waypoint_column column, std::uint32_t most) const {
    const auto text = whole_part(of(column));
    std::uint32_t value = 0;
    const auto [stopped, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (stopped != text.data() + text.size() || failure == std::errc::invalid_argument)
      return wrong(waypoint_errc::not_a_number, in_quotes(text) + " is not a whole number", name_of(column));
    if (failure != std::errc{} || value > most)
      return wrong(waypoint_errc::out_of_range, in_quotes(text) + " is not from 0 to " + std::to_string(most),
                   name_of(column));
    return static_cast<T>(value);
  }

  [[nodiscard]] column_result<float> real(waypoint_column column) const {
    const auto text = of(column);
    if (is_nan_text(text))
      return std::numeric_limits<float>::quiet_NaN();
    float value = 0;
    const auto [stopped, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure == std::errc::result_out_of_range)
      return wrong(waypoint_errc::out_of_range, in_quotes(text) + " does not fit into a float", name_of(column));
    if (failure != std::errc{} || stopped != text.data() + text.size() || !std::isfinite(value))
      return wrong(waypoint_errc::not_a_number, in_quotes(text) + " is neither a number nor NaN", name_of(column));
    return value;
  }

  [[nodiscard]] column_result<std::int32_t> coordinate(coordinate_kind kind, axis which) const {
    const auto column = which == axis::x ? waypoint_column::x : waypoint_column::y;
    return read_coordinate(kind, which, of(column)).map_error([&](waypoint_error error) {
      error.column = name_of(column);
      return error;
    });
  }

  [[nodiscard]] std::string_view of(waypoint_column column) const { return parts_[static_cast<std::size_t>(column)]; }

private:
  const columns& parts_;
};

column_result<columns> split(std::string_view line, waypoint_format format) {
  constexpr std::size_t columns_of_100 = 13;
  const auto expected = format == waypoint_format::version_100 ? columns_of_100 : waypoint_columns.size();
  const auto found = columns_of(line, expected);
  if (found.size() != expected)
    return wrong(waypoint_errc::wrong_columns,
                 (found.size() > expected ? "more than " + std::to_string(expected) : std::to_string(found.size())) +
                     (found.size() == 1 ? " column" : " columns") + "; an item has " + std::to_string(expected) +
                     ", parted by tabs or spaces");
  columns parts;
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts.at(i) = found.at(format == waypoint_format::version_100 ? column_of_100.at(i) : i);
  return parts;
}

// Puts the value of RESULT into TO; the error, if there is one, into ERROR.
template <class T>
bool take(const column_result<T>& result, T& to, waypoint_error& error) {
  if (result)
    to = *result;
  else
    error = result.error();
  return result.has_value();
}

// The item has the index that stands in the file.
column_result<mission_item_int> read_item(std::string_view text, waypoint_format format) {
  const auto parts = split(text, format);
  if (!parts)
    return tl::make_unexpected(parts.error());
  const item_line line(*parts);
  using enum waypoint_column;
  mission_item_int item;
  waypoint_error error;
  if (!take(line.whole<std::uint16_t>(index, std::numeric_limits<std::uint16_t>::max()), item.seq, error) ||
      !take(line.whole<std::uint8_t>(current, 1), item.current, error) ||
      !take(line.whole<std::uint8_t>(frame, std::numeric_limits<std::uint8_t>::max()), item.frame, error) ||
      !take(line.whole<std::uint16_t>(command, std::numeric_limits<std::uint16_t>::max()), item.command, error) ||
      !take(line.whole<std::uint8_t>(autocontinue, 1), item.autocontinue, error))
    return tl::make_unexpected(error);
  const auto kind = coordinates_of(item.frame);
  if (!kind)
    return wrong(waypoint_errc::unknown_frame, in_quotes(line.of(frame)) + " is not the number of a frame of MAVLink",
                 name_of(frame));
  if (!take(line.real(param1), item.param1, error) || !take(line.real(param2), item.param2, error) ||
      !take(line.real(param3), item.param3, error) || !take(line.real(param4), item.param4, error) ||
      !take(line.coordinate(*kind, axis::x), item.x, error) || !take(line.coordinate(*kind, axis::y), item.y, error) ||
      !take(line.real(z), item.z, error))
    return tl::make_unexpected(error);
  if (format == waypoint_format::version_100) {
    const auto known = command_of_100(item.command);
    if (!known)
      return wrong(waypoint_errc::out_of_range, in_quotes(line.of(command)) + " is no action of version 100",
                   name_of(command));
    item.command = *known;
  }
  return item;
}

column_result<waypoint_format> read_header(std::string_view line) {
  if (!line.starts_with(waypoint_magic)) {
    const bool is_json = line.starts_with('{');
    return wrong(
        waypoint_errc::not_a_plan,
        is_json ? std::string("this is JSON, such as a .plan of QGroundControl; save the plan as text (.waypoints)")
                : in_quotes(line) + " where the header \"QGC WPL 110\" was expected");
  }
  const auto version = line.substr(waypoint_magic.size());
  const auto begin = version.find_first_not_of(column_blanks);
  const auto number = begin == std::string_view::npos ? std::string_view() : version.substr(begin);
  if (begin != 0 && (number == waypoint_version || number == "120"))
    return waypoint_format::version_110;
  if (begin != 0 && number == "100")
    return waypoint_format::version_100;
  return wrong(waypoint_errc::other_version, in_quotes(line) + " is not of a version that is read: 100, 110 and 120");
}

// What is read so far, and the rules about the order of lines.
class plan_builder {
public:
  column_result<void> take_line(std::string_view line, std::size_t number, mav_mission_type type) {
    if (line.size() > max_waypoint_line_bytes)
      return wrong(waypoint_errc::too_large, "longer than " + std::to_string(max_waypoint_line_bytes) + " characters");
    line = content_of(line);
    if (line.empty())
      return take_blank();
    if (!format_)
      return read_header(line).map([&](waypoint_format format) { format_ = format; });
    if (plan_.items.size() == max_waypoint_items)
      return wrong(waypoint_errc::too_large, "more than " + std::to_string(max_waypoint_items) + " items");
    return read_item(line, *format_).map([&](mission_item_int item) {
      renumber(item, number);
      item.mission_type = static_cast<std::uint8_t>(type);
      plan_.items.push_back(item);
      plan_.lines.push_back(number);
    });
  }

  [[nodiscard]] bool has_header() const { return format_.has_value(); }
  // Jumps name items by their numbers: where these are not what they count, nobody knows which item is meant.
  [[nodiscard]] waypoint_result<plan_lines> take() {
    const bool has_jump = std::ranges::find(plan_.items, mavlink::number(mav_cmd::do_jump),
                                            &mission_item_int::command) != plan_.items.end();
    if (has_jump && misnumbered_)
      return tl::make_unexpected(*misnumbered_);
    return std::move(plan_);
  }

private:
  column_result<void> take_blank() {
    if (++blank_lines_ > max_waypoint_blank_lines)
      return wrong(waypoint_errc::too_large,
                   "more than " + std::to_string(max_waypoint_blank_lines) + " blank lines and comments");
    return {};
  }

  void renumber(mission_item_int& item, std::size_t line) {
    const auto place = static_cast<std::uint16_t>(plan_.items.size());
    if (item.seq != place && !misnumbered_)
      misnumbered_ = waypoint_error{waypoint_errc::wrong_sequence,
                                    {},
                                    line,
                                    std::string(name_of(waypoint_column::index)),
                                    '"' + std::to_string(item.seq) + "\" where " + std::to_string(place) +
                                        " was expected, and a DO_JUMP of this plan names items by their index"};
    item.seq = place;
  }

  std::optional<waypoint_format> format_; // once the header was read
  std::size_t blank_lines_ = 0;           // and comments
  plan_lines plan_;
  std::optional<waypoint_error> misnumbered_; // the first one
};

} // namespace

waypoint_result<plan_lines> read_plan_lines(std::string_view text, mav_mission_type type) {
  text_lines lines(text);
  plan_builder plan;
  while (const auto line = lines.next())
    if (auto taken = plan.take_line(*line, lines.number(), type); !taken) {
      taken.error().line = lines.number();
      return tl::make_unexpected(taken.error());
    }
  if (!plan.has_header())
    return wrong(waypoint_errc::not_a_plan,
                 text.empty()
                     ? "it is empty; the header \"QGC WPL 110\" was expected"
                     : "nothing is in it but blank lines and comments; the header \"QGC WPL 110\" was expected");
  return plan.take();
}

waypoint_result<std::vector<mission_item_int>> read_waypoints(std::string_view text, mav_mission_type type) {
  return read_plan_lines(text, type).map([](plan_lines plan) { return std::move(plan.items); });
}

} // namespace godwit::io::mavlink
