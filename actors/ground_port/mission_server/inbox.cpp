#include "actors/ground_port/mission_server/inbox.hpp"

#include <algorithm>

namespace godwit::ground_port::mission_server {

void inbox::put(const letter& each, std::int64_t now_ns) {
  if (waiting_.size() == max_waiting_messages) {
    ++dropped_;
    return;
  }
  if (waiting_.empty())
    turn_at_ns_ = std::max(turn_at_ns_, turn_after(now_ns));
  waiting_.push_back(each);
}

std::optional<letter> inbox::take(std::int64_t now_ns) {
  if (now_ns < next_turn_ns())
    return std::nullopt;
  const auto result = waiting_.front();
  waiting_.pop_front();
  turn_at_ns_ += turn_ns_;
  return result;
}

std::int64_t inbox::turn_after(std::int64_t now_ns) const {
  return turn_ns_ == 0 ? now_ns : (now_ns / turn_ns_ + 1) * turn_ns_;
}

} // namespace godwit::ground_port::mission_server
