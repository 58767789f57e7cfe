// Who was heard often enough to be believed: one frame, or a few that somebody has made up, begin nothing.
//
// A sender is believed at its N-th frame within window_ns, this one included. The table is bounded; at the bound the
// one that was silent for longest makes room. Times: monotonic nanoseconds. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace godwit::domain {

// What begins by a heartbeat needs so many where anybody can speak: three that are made up are not enough. At one a
// second that is 3 s.
inline constexpr int heartbeats_to_believe = 4;

class confirmation_table {
public:
  static constexpr std::int64_t window_ns = 5'000'000'000;
  static constexpr std::size_t max_senders = 16;

  // A frame of WHO, a number that the caller makes up of whatever tells senders apart. True: it is believed now.
  [[nodiscard]] bool note(std::uint64_t who, int needed, std::int64_t now_ns);
  void clear() { senders_.clear(); }

private:
  struct sender {
    std::uint64_t who = 0;
    std::deque<std::int64_t> heard_ns; // at most as many as are needed
  };
  [[nodiscard]] sender& find(std::uint64_t who);

  std::vector<sender> senders_;
};

} // namespace godwit::domain
