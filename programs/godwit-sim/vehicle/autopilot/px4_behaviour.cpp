#include "programs/godwit-sim/vehicle/autopilot/px4_behaviour.hpp"

#include <utility>

namespace godwit::sim {

namespace {

constexpr std::uint16_t no_sequence = 65535;

std::optional<stale_messages::message> draw(const stale_messages::plan_before& old,
                                            const io::mavlink::mission_current& now_says, std::uint64_t choice) {
  auto current = now_says;
  switch (choice % 4) {
  case 0:
    current.seq = static_cast<std::uint16_t>(old.current);
    return current;
  case 1:
    current.seq = no_sequence;
    return current;
  case 2:
    if (!old.last_reached)
      return std::nullopt;
    return io::mavlink::mission_item_reached{static_cast<std::uint16_t>(*old.last_reached)};
  default:
    return std::nullopt;
  }
}

} // namespace

std::optional<stale_messages::message> stale_messages::on_switch(const plan_before& old,
                                                                 const io::mavlink::mission_current& now_says,
                                                                 std::mt19937_64& random) {
  const auto drawn = random();
  auto news = draw(old, now_says, drawn);
  constexpr std::uint64_t late_bit = 4;
  if ((drawn & late_bit) == 0)
    return news;
  late_ = news;
  return std::nullopt;
}

std::optional<stale_messages::message> stale_messages::take_late() { return std::exchange(late_, std::nullopt); }

} // namespace godwit::sim
