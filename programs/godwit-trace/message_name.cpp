#include "programs/godwit-trace/message_name.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "io/mavlink/ids.hpp"

namespace godwit::trace_tool {

namespace {

using io::mavlink::message_info;

// Levenshtein's: letters to insert, delete or change.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

} // namespace

void append_message_name(std::string& out, std::uint32_t id) {
  if (const auto* const info = io::mavlink::find_message(id))
    out += info->name;
  else
    out.append(unknown_prefix).append(std::to_string(id));
}

std::string message_name(std::uint32_t id) {
  std::string name;
  append_message_name(name, id);
  return name;
}

std::string_view nearest_message_name(std::string_view text) {
  const auto rank = [&](const message_info& info) {
    const bool contains = !text.empty() && info.name.find(text) != std::string_view::npos;
    return std::pair(!contains, edit_distance(text, info.name));
  };
  return std::ranges::min_element(io::mavlink::known_ids(), {}, rank)->name;
}

} // namespace godwit::trace_tool
