#include "io/mavlink/waypoint_file/waypoint_writer.hpp"

#include <charconv>
#include <cmath>

#include "io/mavlink/waypoint_file/coordinate_text.hpp"
#include "io/mavlink/waypoint_file/format.hpp"

namespace godwit::io::mavlink {

namespace {

// One line in the making. After an error nothing more is written.
class line_writer {
public:
  line_writer(std::string& out, std::size_t line) : out_(out), line_(line) {}

  void whole(waypoint_column column, std::uint32_t value, std::uint32_t most) {
    if (value > most)
      refuse(waypoint_errc::out_of_range, column, std::to_string(value) + " is not from 0 to " + std::to_string(most));
    begin(column);
    out_ += std::to_string(value);
  }

  void real(waypoint_column column, float value) {
    begin(column);
    if (std::isnan(value)) {
      out_ += "NaN";
      return;
    }
    if (!std::isfinite(value))
      refuse(waypoint_errc::not_a_number, column, "an infinity can not be written");
    char digits[32];
    out_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }

  void coordinate(coordinate_kind kind, axis which, std::int32_t value) {
    const auto column = which == axis::x ? waypoint_column::x : waypoint_column::y;
    begin(column);
    if (const auto appended = append_coordinate(out_, kind, which, value); !appended)
      refuse(appended.error().code, column, appended.error().what);
  }

  void refuse(waypoint_errc code, waypoint_column column, std::string what) {
    if (result_)
      result_ = tl::make_unexpected(waypoint_error{code, {}, line_, std::string(name_of(column)), std::move(what)});
  }

  [[nodiscard]] const waypoint_result<void>& result() const { return result_; }

private:
  void begin(waypoint_column column) {
    if (column != waypoint_column::index)
      out_ += '\t';
  }

  std::string& out_;
  std::size_t line_;
  waypoint_result<void> result_;
};

waypoint_result<void> append_item(std::string& out, const mission_item_int& item, std::size_t expected_seq) {
  using enum waypoint_column;
  constexpr std::size_t lines_before = 2; // the header, and lines are counted from 1 on
  line_writer line(out, expected_seq + lines_before);
  if (item.seq != expected_seq)
    line.refuse(waypoint_errc::wrong_sequence, index,
                "seq " + std::to_string(item.seq) + " where " + std::to_string(expected_seq) + " was expected");
  const auto kind = coordinates_of(item.frame);
  if (!kind)
    line.refuse(waypoint_errc::unknown_frame, frame,
                std::to_string(item.frame) + " is not the number of a frame of MAVLink");
  line.whole(index, item.seq, max_waypoint_items - 1);
  line.whole(current, item.current, 1);
  line.whole(frame, item.frame, 255);
  line.whole(command, item.command, 65'535);
  line.real(param1, item.param1);
  line.real(param2, item.param2);
  line.real(param3, item.param3);
  line.real(param4, item.param4);
  line.coordinate(kind.value_or(coordinate_kind::none), axis::x, item.x);
  line.coordinate(kind.value_or(coordinate_kind::none), axis::y, item.y);
  line.real(z, item.z);
  line.whole(autocontinue, item.autocontinue, 1);
  out += '\n';
  return line.result();
}

} // namespace

waypoint_result<std::string> write_waypoints(std::span<const mission_item_int> items) {
  if (items.size() > max_waypoint_items)
    return tl::make_unexpected(waypoint_error{
        waypoint_errc::too_large, {}, 0, {}, "more than " + std::to_string(max_waypoint_items) + " items"});
  std::string out;
  out.append(waypoint_magic).append(" ").append(waypoint_version).append("\n");
  for (std::size_t i = 0; i < items.size(); ++i)
    if (const auto appended = append_item(out, items[i], i); !appended)
      return tl::make_unexpected(appended.error());
  return out;
}

} // namespace godwit::io::mavlink
