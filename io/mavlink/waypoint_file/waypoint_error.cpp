#include "io/mavlink/waypoint_file/waypoint_error.hpp"

namespace godwit::io::mavlink {

std::string waypoint_error::message() const {
  std::string text = file.empty() ? "" : file + ": ";
  if (line != 0)
    text += "line " + std::to_string(line) + (column.empty() ? ": " : ", " + column + ": ");
  return text + what;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t max_quoted = 40;
  std::string shown = "\"";
  for (const char each : text.substr(0, max_quoted))
    shown += each >= ' ' && each <= '~' ? each : '?';
  return shown + (text.size() > max_quoted ? "...\"" : "\"");
}

} // namespace godwit::io::mavlink
