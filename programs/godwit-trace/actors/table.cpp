#include "programs/godwit-trace/actors/table.hpp"

#include <algorithm>

namespace godwit::trace_tool {

void text_table::append_to(std::string& out) const {
  std::vector<std::size_t> widths;
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    auto width = columns_[n].title.size();
    for (const auto& each : rows_)
      width = std::max(width, each.at(n).size());
    widths.push_back(width);
  }
  const auto add_line = [&](const auto& text_of) {
    std::string line;
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      const std::string& text = text_of(n);
      const std::string gap(widths[n] - text.size(), ' ');
      line += n == 0 ? "" : "  ";
      line += columns_[n].is_number ? gap + text : text + gap;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  };
  add_line([this](std::size_t n) -> const std::string& { return columns_[n].title; });
  for (const auto& each : rows_)
    add_line([&each](std::size_t n) -> const std::string& { return each[n]; });
}

} // namespace godwit::trace_tool
