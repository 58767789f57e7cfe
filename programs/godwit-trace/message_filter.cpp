#include "programs/godwit-trace/message_filter.hpp"

#include <utility>

namespace godwit::trace_tool {

namespace {

std::bitset<256> only(std::span<const std::uint8_t> ids) {
  std::bitset<256> result;
  for (const auto each : ids)
    result.set(each);
  return ids.empty() ? result.set() : result;
}

} // namespace

message_filter::message_filter(name_filter names, std::span<const std::uint8_t> systems,
                               std::span<const std::uint8_t> components)
    : names_(std::move(names)), systems_(only(systems)), components_(only(components)) {}

} // namespace godwit::trace_tool
