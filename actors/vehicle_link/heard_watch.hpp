// What is heard and not accepted while there is no vehicle: other autopilots, ground stations, programs, frames that
// are not believed or damaged, with their numbers. It goes into the sentence that says why there is no vehicle.
//
//   ; heard and not accepted: ground station 255/190 (12 heartbeats), autopilot 1/5 (3 heartbeats; its component has to
//   be 1), 17 frames that are not believed
//
// Senders count as heard for others_count_ns, numbers since the vehicle was last there. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "actors/vehicle_link/vehicle_watch.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::vehicle_link {

// Of the channel, since its start.
struct unusable_frames {
  std::uint64_t unbelieved = 0; // for their signature
  std::uint64_t damaged = 0;
  std::uint64_t of_mavlink_1 = 0;
};

class heard_watch {
public:
  static constexpr std::size_t max_senders = 8; // the longest silent one makes room
  // What is heard is announced when it has changed, and no sooner than this after the last time or the silence began: a
  // vehicle that is accepted at its fourth heartbeat causes no such sentence.
  static constexpr std::int64_t announces_after_ns = 5'000'000'000;

  explicit heard_watch(const watch_settings& expected) : expected_(expected) {}

  // The vehicle was accepted, is lost, or the link opens.
  void restart(const unusable_frames& until_now, std::int64_t now_ns);
  void on_frame(const io::mavlink::frame_view& frame, std::int64_t now_ns);

  // As above; empty: nothing.
  [[nodiscard]] std::string sentence(const unusable_frames& until_now, std::int64_t now_ns) const;
  [[nodiscard]] bool may_be_announced(std::int64_t now_ns) const {
    return now_ns - announced_ns_ >= announces_after_ns;
  }
  // Others are heard than at the last announcement, whatever the numbers; this is one now.
  [[nodiscard]] bool on_announcement(const unusable_frames& until_now, std::int64_t now_ns);

private:
  enum class kind { without_heartbeat, autopilot, ground_station, program };
  struct sender_heard {
    io::mavlink::sender who;
    kind what = kind::without_heartbeat;
    std::uint64_t frames = 0;
    std::uint64_t heartbeats = 0;
    std::int64_t last_ns = 0;
  };
  enum class with { numbers, names_alone };

  [[nodiscard]] sender_heard& entry_of(io::mavlink::sender who);
  [[nodiscard]] std::string list(const unusable_frames& until_now, std::int64_t now_ns, with what) const;
  [[nodiscard]] std::string described(const sender_heard& each, with what) const;

  watch_settings expected_;
  std::vector<sender_heard> senders_; // by name
  unusable_frames before_;
  std::string announced_;
  std::int64_t announced_ns_ = 0;
};

} // namespace godwit::vehicle_link
