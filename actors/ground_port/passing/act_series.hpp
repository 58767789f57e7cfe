// Which of what people do through stations is a row of the audit: each act, but of what comes many times a second or in
// hundreds (sticks, parameters) the first one.
//
// A series is the same kind of act by the same station with the same outcome; it has ended when it was silent for
// silent_ns. Over the bound the one that was heard longest ago is forgotten, and would be a row again. Pure. Times: ns,
// monotonic. Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/executor/station_act.hpp"

namespace godwit::ground_port::passing {

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

} // namespace godwit::ground_port::passing
