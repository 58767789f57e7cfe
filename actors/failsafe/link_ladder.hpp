// How long the operator's ground station has been silent, and what that means.
//
//            < 5 s          5..30 s: warn, fly on     >= 30 s: return
//   never_seen ──heard──> ok ───────────> degraded ───────────> lost
//                         ^                  │                   │
//                         └──────heard───────┴──────heard────────┘
//
// Whoever hands the vehicle back while it is lost knows that, and is there by another way: the silent station counts
// again when it is heard. Where an operator is required the silence counts from the hand-back.
//
// While an object is followed the last step comes 30 s later. Who was never heard is never lost, except where an
// operator is required: then the silence counts from the start. That the phase goes back to ok cancels nothing; the
// latch of the rule sees to that. Evaluated at each tick; that nobody reports any more is silence too. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/settings.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::failsafe {

enum class link_phase { off, never_seen, ok, degraded, lost };

// A new start never makes the link lost by itself: the station has so long to be heard again.
inline constexpr std::int64_t link_restart_grace_ms = 5'000;

// What must survive: it changes with the phase only, not with each heartbeat.
struct link_memory {
  bool seen = false;
  std::optional<std::int64_t> silent_since_ns; // wall clock; absent while it is ok
  bool following = false;
  bool silence_is_known = false; // to the person who has handed the vehicle back in it

  GODWIT_FIELDS(link_memory, "failsafe.link_memory", seen, silent_since_ns, following, silence_is_known);
  friend bool operator==(const link_memory&, const link_memory&) = default;
};

class link_ladder {
public:
  link_ladder(const settings& configured, const link_memory& restored, instant now);

  // A port that was restarted has never heard anybody: that says nothing of what was before.
  void on_report(bool ever_heard, std::int64_t age_ms, instant now);
  // Whoever has control on the page or by the API is there: the silence of a station begins anew. That alone makes
  // nobody a station that can be lost: who closes the page has not called the vehicle home.
  void on_controller(instant now) { heard_ns_ = now.monotonic_ns; }
  // True: the link was lost, and is not waited for any more.
  bool on_hand_back(instant now);
  void on_following(bool following) { memory_.following = following; }

  [[nodiscard]] link_phase evaluate(instant now);
  [[nodiscard]] const link_memory& memory() const { return memory_; }

private:
  [[nodiscard]] std::int64_t lost_after_ms() const;

  settings settings_;
  link_memory memory_;
  std::int64_t heard_ns_ = 0; // monotonic; the start, before anybody was heard
};

} // namespace godwit::failsafe
