// The table of the failsafes: what may trigger, what is done about it by each class of vehicle, and what comes first.
//
//   priority  rule              multirotor  fixed wing                        rover   an operator may override it
//   1         battery_critical  land        return, or the mission's landing  hold    never
//   2         fence             return      return                            hold    until a deadline
//   3         battery_low       return      return                            return  until a deadline
//   4         operator_link     return      return                            return  until a deadline
//
// Where a return would not lead to the mission's home, after a landing on the way, the vehicle holds in its place.
// That the link to the autopilot is down is no rule: nothing could be sent, and the autopilot's own failsafe acts.
// A lower rule never cancels what a higher one does. Thread: constants.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "actors/failsafe/events.hpp"
#include "io/fields/field_table.hpp"
#include "messages/failsafe/types.hpp"

namespace godwit::failsafe {

inline constexpr std::array rules{rule::battery_critical, rule::fence, rule::battery_low, rule::operator_link};

[[nodiscard]] constexpr std::size_t index_of(rule each) { return static_cast<std::size_t>(each); }
[[nodiscard]] constexpr int priority_of(rule each) { return static_cast<int>(each) + 1; }
[[nodiscard]] constexpr bool is_higher(rule one, rule other) { return priority_of(one) < priority_of(other); }

// A vehicle that falls out of the sky is no operator's choice.
[[nodiscard]] constexpr bool may_be_overridden(rule each) { return each != rule::battery_critical; }

// Nothing for a vehicle of which it is not known what it is.
[[nodiscard]] std::optional<action> action_for(rule each, vehicle_class what, bool mission_has_land_start);

// Whether a vehicle in this mode does already what the action wants. Who lands needs no return.
[[nodiscard]] bool is_done_by(action wanted, mode_kind mode);

// The modes into which a vehicle may go when it is told to do this.
[[nodiscard]] std::array<mode_kind, 2> modes_of(action wanted);

// Which rules have had their say in this flight: a rule acts on an edge, once, and then it is latched.
//
//   free ──edge, nothing higher acts──────────────> acted
//   free ──edge, a higher rule acts───────────────> covered
//   free ──edge, a pilot has the vehicle──────────> left_to_pilot
//   any  ──end of the flight, hand-back───────────> free
//   any  ──override of the rule───────────────────> free; and all, when that lifts what is being done
//
// That the cause goes away frees nothing: the link that comes back does not cancel the return, and a vehicle that comes
// back over its fence flies home all the same. Thread: pure.
enum class latch_kind { acted, covered, left_to_pilot };

GODWIT_ENUM_NAMES(latch_kind, acted, covered, left_to_pilot);

struct latch {
  rule of = rule::operator_link;
  latch_kind how = latch_kind::acted;

  GODWIT_FIELDS(latch, "failsafe.latch", of, how);
  friend bool operator==(const latch&, const latch&) = default;
};

class latch_table {
public:
  explicit latch_table(std::vector<latch> restored) : latches_(std::move(restored)) {}

  [[nodiscard]] bool holds(rule of) const {
    return std::any_of(latches_.begin(), latches_.end(), [&](const latch& each) { return each.of == of; });
  }
  void set(rule of, latch_kind how) {
    release(of);
    latches_.push_back({of, how});
  }
  void release(rule of) {
    std::erase_if(latches_, [&](const latch& each) { return each.of == of; });
  }
  void release_all() { latches_.clear(); }
  [[nodiscard]] const std::vector<latch>& all() const { return latches_; }

private:
  std::vector<latch> latches_; // at most one for each rule
};

} // namespace godwit::failsafe
