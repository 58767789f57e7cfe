#include "actors/ground_port/passing/forwarded_commands.hpp"

#include <algorithm>

namespace godwit::ground_port::passing {

void forwarded_commands::forget_old(std::int64_t now_ns) {
  std::erase_if(waiting_, [&](const forwarded& each) { return now_ns - each.since_ns >= known_for_ns; });
}

void forwarded_commands::put(io::mavlink::sender by, std::array<std::uint16_t, 2> answered_as, std::uint64_t number,
                             std::int64_t now_ns) {
  forget_old(now_ns);
  if (waiting_.size() == max_forwarded)
    waiting_.erase(waiting_.begin());
  waiting_.push_back({by, answered_as, number, now_ns});
}

std::vector<std::uint64_t> forwarded_commands::acknowledge(io::mavlink::sender to, std::uint16_t command,
                                                           std::int64_t now_ns) {
  forget_old(now_ns);
  std::vector<std::uint64_t> result;
  std::erase_if(waiting_, [&](const forwarded& each) {
    const bool is_it = each.by == to && std::ranges::find(each.answered_as, command) != each.answered_as.end();
    if (is_it)
      result.push_back(each.number);
    return is_it;
  });
  return result;
}

} // namespace godwit::ground_port::passing
