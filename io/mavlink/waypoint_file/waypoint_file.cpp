#include "io/mavlink/waypoint_file/waypoint_file.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "io/mavlink/waypoint_file/coordinate_text.hpp"
#include "io/mavlink/waypoint_file/fence_rally_reader.hpp"
#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::io::mavlink {

namespace {

namespace fs = std::filesystem;

struct closer {
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};
using file_handle = std::unique_ptr<std::FILE, closer>;

tl::unexpected<waypoint_error> refused(const fs::path& path, std::string what) {
  return tl::make_unexpected(waypoint_error{waypoint_errc::io, path.string(), 0, {}, std::move(what)});
}

std::string words_of(int number) { return std::generic_category().message(number); }

waypoint_result<std::string> read_text(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return refused(path, "it is a folder, not a file");
  const file_handle file(std::fopen(path.c_str(), "rb"));
  if (!file)
    return refused(path, words_of(errno));
  std::string text;
  char piece[16 * 1024];
  while (const auto got = std::fread(piece, 1, sizeof piece, file.get())) {
    text.append(piece, got);
    if (text.size() > max_waypoint_file_bytes)
      return tl::make_unexpected(
          waypoint_error{waypoint_errc::too_large, path.string(), 0, {}, "it is too large for a plan"});
  }
  if (std::ferror(file.get()) != 0)
    return refused(path, words_of(errno));
  return text;
}

waypoint_result<void> write_text(const fs::path& path, const std::string& text) {
  file_handle file(std::fopen(path.c_str(), "wb"));
  if (!file)
    return refused(path, words_of(errno));
  if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() || std::fclose(file.release()) != 0)
    return refused(path, words_of(errno));
  return {};
}

template <class T>
waypoint_result<T> in_file(waypoint_result<T> result, const fs::path& path) {
  if (!result)
    result.error().file = path.string();
  return result;
}

} // namespace

waypoint_result<std::vector<mission_item_int>> load_waypoint_file(const fs::path& path, mav_mission_type type) {
  const auto text = read_text(path);
  if (!text)
    return tl::make_unexpected(text.error());
  const auto only_items = [](plan_lines plan) { return std::move(plan.items); };
  const auto holds = fence_or_rally(*text);
  if (!holds)
    return in_file(read_waypoints(*text, type), path);
  if (*holds != type)
    return refused(path, *holds == mav_mission_type::fence ? "it holds a fence" : "it holds rally points");
  return in_file(
      (*holds == mav_mission_type::fence ? read_fence_lines(*text) : read_rally_lines(*text)).map(only_items), path);
}

waypoint_result<void> save_waypoint_file(const fs::path& path, std::span<const mission_item_int> items) {
  const auto text = in_file(write_waypoints(items), path);
  if (!text)
    return tl::make_unexpected(text.error());
  // A device or a pipe is written to; it can not be replaced.
  std::error_code code;
  const auto kind = fs::status(path, code).type();
  if (kind != fs::file_type::regular && kind != fs::file_type::not_found && kind != fs::file_type::directory)
    return write_text(path, *text);
  const fs::path beside = path.string() + ".new";
  auto written = write_text(beside, *text);
  code.clear();
  if (written)
    fs::rename(beside, path, code);
  if (written && !code)
    return {};
  std::error_code ignored;
  fs::remove(beside, ignored);
  return refused(path, written ? code.message() : written.error().what);
}

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
