#include "actors/failsafe/first_look.hpp"

#include <algorithm>

namespace godwit::failsafe {

void first_look::heard(std::uint32_t message_id) {
  for (auto& each : wanted_)
    if (each.message_id == message_id && --each.needed <= 0)
      each.tries_left = 0;
}

std::optional<std::uint32_t> first_look::next(bool at_tick) {
  if (at_tick)
    for (auto& each : wanted_)
      each.is_asked = false;
  if (asking_)
    return std::nullopt;
  const auto found = std::find_if(wanted_.begin(), wanted_.end(),
                                  [](const wanted_message& each) { return each.tries_left > 0 && !each.is_asked; });
  if (found == wanted_.end())
    return std::nullopt;
  --found->tries_left;
  found->is_asked = true;
  asking_ = true;
  return found->message_id;
}

} // namespace godwit::failsafe
