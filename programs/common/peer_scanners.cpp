#include "programs/common/peer_scanners.hpp"

namespace godwit::programs {

namespace {

void add(io::mavlink::scan_counters& to, const io::mavlink::scan_counters& more) {
  using io::mavlink::scan_counters;
  for (auto scan_counters::*const each :
       {&scan_counters::bytes, &scan_counters::frames, &scan_counters::bad_crc, &scan_counters::unknown_id,
        &scan_counters::unknown_flag, &scan_counters::v1_frames, &scan_counters::cut_off,
        &scan_counters::garbage_bytes})
    to.*each += more.*each;
  for (std::size_t i = 0; i < to.kinds.size(); ++i) {
    to.kinds[i].received += more.kinds[i].received;
    to.kinds[i].bad_crc += more.kinds[i].bad_crc;
  }
}

} // namespace

io::mavlink::scanner& peer_scanners::scanner_of(io::link::peer_id peer) {
  if (!scanners_.contains(peer) && scanners_.size() == max_peers) { // peers are numbered as they come
    add(forgotten_, scanners_.begin()->second.counters());
    scanners_.erase(scanners_.begin());
  }
  return scanners_[peer];
}

std::size_t peer_scanners::waiting_bytes() const {
  std::size_t result = 0;
  for (const auto& [peer, each] : scanners_)
    result += each.waiting_bytes();
  return result;
}

io::mavlink::scan_counters peer_scanners::counters() const {
  auto result = forgotten_;
  for (const auto& [peer, each] : scanners_)
    add(result, each.counters());
  return result;
}

std::vector<io::mavlink::sender_counters> peer_scanners::senders() const {
  std::vector<io::mavlink::sender_counters> result;
  for (const auto& [peer, each] : scanners_)
    result.insert(result.end(), each.senders().all().begin(), each.senders().all().end());
  return result;
}

} // namespace godwit::programs
