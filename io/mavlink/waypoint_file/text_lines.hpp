// The lines of a plan file, without their ends, comments and blanks. Thread: pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace godwit::io::mavlink {

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
