// What people have said through stations, and the executor has not answered for: only then does it go on.
//
//   (none) ──put()──> asked ──resolve()──> whoever called it passes it on, or refuses it
//
// A repetition of a command that is asked for already is not asked again. Of a stream the newest takes the place of the
// one that waits: the executor is asked as often as it answers. What comes over the bound is dropped and counted. Not
// kept over a crash: the station says it again. Pure. Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/ground_port/vehicle_role/order.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/vehicle_link/evidence.hpp"

namespace godwit::ground_port::passing {

struct waiting_act {
  executor::station_act act;
  vehicle_link::relayed_frame frame;
  std::optional<vehicle_role::order> order = {}; // of a command: what is answered when it does not go on
  std::uint64_t request = 0;
};

class act_queue {
public:
  static constexpr std::size_t max_waiting = 32;

  // Requests are numbered from FIRST on: an answer to an act of an earlier life is none to one of this.
  explicit act_queue(std::uint64_t first = 1) : next_request_(first), first_request_(first) {}

  // The number of the request to the executor; nothing: it is not to be asked.
  [[nodiscard]] std::optional<std::uint64_t> put(waiting_act what);
  [[nodiscard]] std::optional<waiting_act> resolve(std::uint64_t request);

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] std::uint64_t replaced() const { return replaced_; } // of streams
  [[nodiscard]] std::uint64_t asked() const { return next_request_ - first_request_; }

private:
  std::vector<waiting_act> waiting_;
  std::uint64_t next_request_;
  std::uint64_t first_request_;
  std::uint64_t dropped_ = 0;
  std::uint64_t replaced_ = 0;
};

// Which of what people do through stations is a row of the audit: each act, but of what comes many times a second or in
// hundreds (sticks, parameters) the first one.
//
// A series is the same kind of act by the same station with the same outcome; it has ended when it was silent for
// silent_ns. Over the bound the one that was heard longest ago is forgotten, and would be a row again. Pure. Times: ns,
// monotonic. Thread: one at a time.
class act_series {
public:
  static constexpr std::int64_t silent_ns = 5'000'000'000;
  static constexpr std::size_t max_series = 32;

  // True: it is a row.
  [[nodiscard]] bool begins(const executor::station_act& act, const std::string& outcome, std::int64_t now_ns) {
    if (act.kind != executor::act_kind::stream && act.kind != executor::act_kind::configure)
      return true;
    std::erase_if(known_, [&](const series& each) { return now_ns - each.heard_ns > silent_ns; });
    const auto is_of_it = [&](const series& each) {
      return each.by == act.by && each.what == act.what && each.outcome == outcome;
    };
    const auto found = std::ranges::find_if(known_, is_of_it);
    const bool is_new = found == known_.end();
    if (!is_new)
      known_.erase(found);
    else if (known_.size() == max_series)
      known_.erase(known_.begin());
    known_.push_back({act.by, act.what, outcome, now_ns});
    return is_new;
  }

private:
  struct series {
    executor::station by;
    std::string what;
    std::string outcome;
    std::int64_t heard_ns = 0;
  };
  std::vector<series> known_; // the one that was heard longest ago first
};

// So many frames and bytes a second go on, and no more: what runs over is not passed on, and counted.
//
// A second's worth may come at once. Pure. Times: ns, monotonic. Thread: one at a time.
class budget {
public:
  struct rate {
    std::int64_t frames_per_s = 0;
    std::int64_t bytes_per_s = 0;
  };

  explicit budget(rate most)
      : most_(most), frames_left_(most.frames_per_s * per_s), bytes_left_(most.bytes_per_s * per_s) {}

  // True: it goes on, and is paid for.
  [[nodiscard]] bool take(std::size_t bytes, std::int64_t now_ns) {
    const auto passed = std::clamp<std::int64_t>(now_ns - last_ns_, 0, per_s);
    last_ns_ = now_ns;
    frames_left_ = std::min(most_.frames_per_s * per_s, frames_left_ + passed * most_.frames_per_s);
    bytes_left_ = std::min(most_.bytes_per_s * per_s, bytes_left_ + passed * most_.bytes_per_s);
    const auto costs = static_cast<std::int64_t>(bytes) * per_s;
    if (frames_left_ < per_s || bytes_left_ < costs) {
      ++dropped_;
      return false;
    }
    frames_left_ -= per_s;
    bytes_left_ -= costs;
    return true;
  }

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; } // frames

private:
  static constexpr std::int64_t per_s = 1'000'000'000; // the unit: a frame, or byte, for one nanosecond

  rate most_;
  std::int64_t frames_left_; // in units
  std::int64_t bytes_left_;  // the same
  std::int64_t last_ns_ = 0;
  std::uint64_t dropped_ = 0;
};

} // namespace godwit::ground_port::passing
