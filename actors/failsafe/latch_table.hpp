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
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "actors/failsafe/rules.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::failsafe {

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
