#include "io/link/peer_table.hpp"

#include <algorithm>

namespace godwit::io::link {

peer_table::peer_table(std::size_t max_peers, std::chrono::milliseconds forget_after)
    : max_peers_(max_peers), forget_after_(forget_after) {
  peers_.reserve(max_peers);
}

peer_id peer_table::heard(const endpoint& address, time_point now) {
  forget_silent(now);
  for (auto& each : peers_) {
    if (each.address == address) {
      each.heard_at = now;
      return each.id;
    }
  }
  if (peers_.size() == max_peers_ && !makes_room(now)) {
    ++refused_;
    return free_id();
  }
  peers_.push_back({free_id(), address, now});
  return last_id_;
}

void peer_table::forget_silent(time_point now) {
  forgotten_ += std::erase_if(peers_, [&](const peer& each) { return now - each.heard_at >= forget_after_; });
}

bool peer_table::makes_room(time_point now) {
  const auto earlier = [](const peer& a, const peer& b) { return a.heard_at < b.heard_at; };
  const auto longest = std::min_element(peers_.begin(), peers_.end(), earlier);
  if (now - longest->heard_at < keeps_place)
    return false;
  peers_.erase(longest);
  ++evicted_;
  return true;
}

// Numbers start again after four billion peers, which a flood reaches in a day; a number in use is then left out.
peer_id peer_table::free_id() {
  const auto in_use = [this](peer_id id) {
    return std::any_of(peers_.begin(), peers_.end(), [id](const peer& each) { return each.id == id; });
  };
  do {
    ++last_id_;
  } while (last_id_ == every_peer || in_use(last_id_));
  return last_id_;
}

} // namespace godwit::io::link
