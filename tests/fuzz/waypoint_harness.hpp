// What must hold for any text that is read as a plan file; the fuzzer tries texts, and a test plants defects to show
// that they are found.
//
//   - what is refused has a sentence, and a line that is in the text (a text without a header line has none);
//   - what is read keeps the bounds: items numbered from 0 on, positions on earth;
//   - it can be written, and what was written reads back and is then written the same again.
//
// Reader and writer are passed in as a type. Thread: pure.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "io/mavlink/waypoint_file/coordinate_text.hpp"
#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_file.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::io::mavlink::fuzz {

struct real_waypoints {
  static auto read(std::string_view text) { return read_waypoints(text); }
  static auto write(std::span<const mission_item_int> items) { return write_waypoints(items); }
};

inline std::optional<std::string> check_item(const mission_item_int& item, std::size_t index) {
  if (item.seq != index)
    return "items out of order";
  const auto kind = coordinates_of(item.frame);
  if (!kind)
    return "an unknown frame was accepted";
  if (kind == coordinate_kind::global && (std::abs(item.x) > 900'000'000 || std::abs(item.y) > 1'800'000'000))
    return "a position that is not on earth was accepted";
  return std::nullopt;
}

// Whether every line is blank or a comment: such a text is refused as a whole, without a line.
inline bool has_no_header_line(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3);
  while (!text.empty()) {
    auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.ends_with('\r'))
      line.remove_suffix(1);
    if (line.substr(0, line.find('#')).find_first_not_of(" \t") != std::string_view::npos)
      return false;
  }
  return true;
}

template <class Waypoints = real_waypoints>
std::optional<std::string> check_waypoints(std::string_view text) {
  const auto items = Waypoints::read(text);
  if (!items) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
    const bool has_place = items.error().line <= lines && (items.error().line != 0 || has_no_header_line(text));
    return has_place && !items.error().what.empty() ? std::nullopt : std::optional("an error without words or place");
  }
  if (items->size() > max_waypoint_items)
    return "too many items";
  for (std::size_t i = 0; i < items->size(); ++i)
    if (auto found = check_item((*items)[i], i))
      return found;
  const auto written = Waypoints::write(*items);
  if (!written)
    return "what was read can not be written: " + written.error().message();
  const auto again = Waypoints::read(*written);
  if (!again)
    return "what was written can not be read: " + again.error().message();
  if (Waypoints::write(*again) != written)
    return "written, read and written again it is another text";
  return std::nullopt;
}

} // namespace godwit::io::mavlink::fuzz
