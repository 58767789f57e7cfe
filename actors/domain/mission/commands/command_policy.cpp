#include "actors/domain/mission/commands/command_policy.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "actors/domain/mission/commands/command_table.hpp"

namespace godwit::mission {

namespace {

std::string unless_allowed(std::string_view reason, std::uint16_t command) {
  return std::string(reason) + "; flight.allowed_commands allows it where it names " + std::to_string(command);
}

} // namespace

std::optional<std::uint16_t> command_number(std::string_view text) {
  std::uint16_t number = 0;
  const auto [stopped, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure == std::errc{} && stopped == text.data() + text.size())
    return number == 0 ? std::nullopt : std::optional(number);
  const auto* const row = command_named(text);
  return row == nullptr ? std::nullopt : std::optional(row->id);
}

bool is_never_carried(std::uint16_t command) {
  const auto* const row = command_of(command);
  return row != nullptr && row->kind == command_class::never;
}

std::string why_not_carried(std::uint16_t command, std::span<const std::uint16_t> allowed) {
  const bool is_allowed = std::ranges::find(allowed, command) != allowed.end();
  const auto* const row = command_of(command);
  if (row == nullptr)
    return is_allowed ? std::string() : unless_allowed("its number is not known", command);
  switch (row->kind) {
  case command_class::never:
    return "no mission may stop motors, change the mode, pause or start a mission";
  case command_class::fence:
    return "it belongs to the fence, and vehicles refuse it among the items of a mission";
  case command_class::rally:
    return "it belongs to the rally points, and vehicles refuse it among the items of a mission";
  case command_class::guarded:
    return is_allowed
               ? std::string()
               : unless_allowed("what it does can not be judged before the flight, or takes protection away", command);
  case command_class::moves:
  case command_class::acts:
  case command_class::waits:
  case command_class::flow:
    break;
  }
  return row->is_taken_by_anyone() ? std::string() : "every vehicle refuses a mission with it";
}

} // namespace godwit::mission
