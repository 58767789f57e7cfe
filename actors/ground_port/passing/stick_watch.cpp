#include "actors/ground_port/passing/stick_watch.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

#include "actors/ground_port/passing/payload_byte.hpp"

namespace godwit::ground_port::passing {

namespace {

constexpr std::size_t x_at = 0;
constexpr std::size_t y_at = 2;
constexpr std::size_t z_at = 4;
constexpr std::size_t r_at = 6;
constexpr std::size_t buttons_at = 8;

unsigned word_at(io::mavlink::byte_view payload, std::size_t at) {
  return byte_at(payload, at) | static_cast<unsigned>(byte_at(payload, at + 1)) << 8U;
}

int axis_at(io::mavlink::byte_view payload, std::size_t at) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(word_at(payload, at)));
}

bool is_away(int value, int from) {
  return value != std::numeric_limits<std::int16_t>::max() && std::abs(value - from) > stick_watch::held_from;
}

} // namespace

bool stick_watch::is_held(io::mavlink::sender by, io::mavlink::byte_view payload, std::int64_t now_ns) {
  std::erase_if(known_, [&](const rest& each) { return now_ns - each.heard_ns > silent_ns; });
  rest now{by, axis_at(payload, z_at), word_at(payload, buttons_at), now_ns};
  const auto found = std::ranges::find(known_, by, &rest::by);
  auto before = found == known_.end() ? now : *found;
  if (found != known_.end())
    known_.erase(found);
  else if (known_.size() == max_stations)
    known_.erase(known_.begin());
  const bool is_moved = is_away(now.throttle, before.throttle) || now.buttons != before.buttons;
  if (!is_moved)
    now.throttle = before.throttle;
  known_.push_back(now);
  return is_moved || std::ranges::any_of(std::array{x_at, y_at, r_at},
                                         [&](std::size_t at) { return is_away(axis_at(payload, at), 0); });
}

} // namespace godwit::ground_port::passing
