#include "programs/godwit-sim/host/frame_finder.hpp"

#include <algorithm>

namespace godwit::sim {

frame_finder::torn_stream& frame_finder::stream_of(io::link::peer_id from) {
  const auto found =
      std::find_if(streams_.begin(), streams_.end(), [from](const auto& each) { return each.from == from; });
  if (found != streams_.end())
    return *found;
  if (streams_.size() == max_streams) {
    const auto earlier = [](const torn_stream& a, const torn_stream& b) { return a.heard_ns < b.heard_ns; };
    streams_.erase(std::min_element(streams_.begin(), streams_.end(), earlier));
  }
  return streams_.emplace_back(torn_stream{from, 0, std::make_unique<io::mavlink::scanner>()});
}

std::int64_t frame_finder::next_deadline_ns() const {
  auto next = never;
  for (const auto& each : streams_)
    if (each.scanner->waiting_bytes() != 0)
      next = std::min(next, each.heard_ns + silence_ns);
  return next;
}

void frame_finder::forget(io::link::peer_id who) {
  std::erase_if(streams_, [who](const torn_stream& each) { return each.from == who; });
}

} // namespace godwit::sim
