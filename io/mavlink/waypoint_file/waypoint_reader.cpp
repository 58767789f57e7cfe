#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/waypoint_file/coordinate_text.hpp"
#include "io/mavlink/waypoint_file/format.hpp"

namespace godwit::io::mavlink {

namespace {

constexpr std::string_view blanks = " \t";
constexpr char comment_mark = '#';
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

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

// The parts of one line; each column has a name.
class item_line {
public:
  explicit item_line(const columns& parts) : parts_(parts) {}

  template <class T>
  [[nodiscard]] column_result<T> whole(waypoint_column column, std::uint32_t most) const {
    const auto text = of(column);
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

column_result<columns> split(std::string_view line) {
  columns parts;
  std::size_t count = 0;
  for (auto at = line.find_first_not_of(blanks); at != std::string_view::npos;
       at = line.find_first_not_of(blanks, at)) {
    const auto end = std::min(line.find_first_of(blanks, at), line.size());
    if (count < parts.size())
      parts[count] = line.substr(at, end - at);
    ++count;
    at = end;
  }
  if (count != parts.size())
    return wrong(waypoint_errc::wrong_columns, std::to_string(count) + (count == 1 ? " column" : " columns") +
                                                   "; an item has " + std::to_string(parts.size()) +
                                                   ", parted by tabs or spaces");
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
column_result<mission_item_int> read_item(std::string_view text) {
  const auto parts = split(text);
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
  return item;
}

column_result<void> check_header(std::string_view line) {
  if (!line.starts_with(waypoint_magic)) {
    const bool is_json = line.starts_with('{');
    return wrong(
        waypoint_errc::not_a_plan,
        is_json ? std::string("this is JSON, such as a .plan of QGroundControl; save the plan as text (.waypoints)")
                : in_quotes(line) + " where the header \"QGC WPL 110\" was expected");
  }
  const auto version = line.substr(waypoint_magic.size());
  const auto begin = version.find_first_not_of(blanks);
  if (begin == 0 || begin == std::string_view::npos || version.substr(begin) != waypoint_version)
    return wrong(waypoint_errc::other_version, in_quotes(line) + " is not version 110, the only one that is read");
  return {};
}

// Gives out a text line by line, without their ends.
class line_splitter {
public:
  explicit line_splitter(std::string_view text) : rest_(text) {}

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

// Nor the comment that ends the line.
std::string_view without_blanks_after(std::string_view line) {
  line = line.substr(0, line.find(comment_mark));
  const auto last = line.find_last_not_of(blanks);
  return last == std::string_view::npos ? std::string_view() : line.substr(0, last + 1);
}

// What is read so far, and the rules about the order of lines.
class plan_builder {
public:
  column_result<void> take_line(std::string_view line, std::size_t number, mav_mission_type type) {
    if (line.size() > max_waypoint_line_bytes)
      return wrong(waypoint_errc::too_large, "longer than " + std::to_string(max_waypoint_line_bytes) + " characters");
    line = without_blanks_after(line);
    if (line.empty())
      return take_blank();
    if (!has_header_) {
      has_header_ = true;
      return check_header(line);
    }
    if (items_.size() == max_waypoint_items)
      return wrong(waypoint_errc::too_large, "more than " + std::to_string(max_waypoint_items) + " items");
    return read_item(line).map([&](mission_item_int item) {
      renumber(item, number);
      item.mission_type = static_cast<std::uint8_t>(type);
      items_.push_back(item);
    });
  }

  [[nodiscard]] bool has_header() const { return has_header_; }
  // Jumps name items by their numbers: where these are not what they count, nobody knows which item is meant.
  [[nodiscard]] waypoint_result<std::vector<mission_item_int>> take() {
    const bool has_jump =
        std::ranges::find(items_, number(mav_cmd::do_jump), &mission_item_int::command) != items_.end();
    if (has_jump && misnumbered_)
      return tl::make_unexpected(*misnumbered_);
    return std::move(items_);
  }

private:
  column_result<void> take_blank() {
    if (++blank_lines_ > max_waypoint_blank_lines)
      return wrong(waypoint_errc::too_large,
                   "more than " + std::to_string(max_waypoint_blank_lines) + " blank lines and comments");
    return {};
  }

  void renumber(mission_item_int& item, std::size_t line) {
    const auto place = static_cast<std::uint16_t>(items_.size());
    if (item.seq != place && !misnumbered_)
      misnumbered_ = waypoint_error{waypoint_errc::wrong_sequence,
                                    {},
                                    line,
                                    std::string(name_of(waypoint_column::index)),
                                    '"' + std::to_string(item.seq) + "\" where " + std::to_string(place) +
                                        " was expected, and a DO_JUMP of this plan names items by their index"};
    item.seq = place;
  }

  bool has_header_ = false;
  std::size_t blank_lines_ = 0; // and comments
  std::vector<mission_item_int> items_;
  std::optional<waypoint_error> misnumbered_; // the first one
};

} // namespace

waypoint_result<std::vector<mission_item_int>> read_waypoints(std::string_view text, mav_mission_type type) {
  if (text.starts_with(byte_order_mark))
    text.remove_prefix(byte_order_mark.size());
  line_splitter lines(text);
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

} // namespace godwit::io::mavlink
