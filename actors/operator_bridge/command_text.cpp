#include "actors/operator_bridge/command_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "io/fields/json_text.hpp"
#include "messages/mission/item_fields.hpp"
#include "messages/operator_bridge/command.hpp"

namespace godwit::operator_bridge {

std::string words_of(const operators::command& what) {
  std::string result(io::name_of(what.kind));
  if (what.kind == operators::command_kind::acknowledge)
    result += ' ' + std::to_string(what.report);
  if (what.place) {
    std::array<char, 96> text{};
    (void)std::snprintf(text.data(), text.size(), " %.6f,%.6f,%.1f", what.place->latitude, what.place->longitude,
                        what.place->altitude_m);
    result += text.data();
  }
  return result;
}

std::string text_of(operators::command what) {
  what.by.clear();
  return io::to_json(what);
}

bool is_command_id(std::string_view id) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-._:~").find(c) != std::string_view::npos;
  };
  return !id.empty() && id.size() <= max_command_id && std::ranges::all_of(id, is_allowed);
}

} // namespace godwit::operator_bridge
