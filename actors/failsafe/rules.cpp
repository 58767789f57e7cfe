#include "actors/failsafe/rules.hpp"

#include "runtime/assert.hpp"

namespace godwit::failsafe {

namespace {

struct row {
  rule each;
  action multirotor;
  action fixed_wing;
  action fixed_wing_with_land_start;
  action rover;
};

using enum action;

constexpr std::array table{
    row{rule::battery_critical, land, return_home, do_land_start, hold},
    row{rule::fence, return_home, return_home, return_home, hold},
    row{rule::battery_low, return_home, return_home, return_home, return_home},
    row{rule::operator_link, return_home, return_home, return_home, return_home},
};
static_assert(table.size() == rules.size());

} // namespace

std::optional<action> action_for(rule each, vehicle_class what, bool mission_has_land_start) {
  const auto& found = table.at(index_of(each));
  GODWIT_ASSERT(found.each == each, "failsafe: the table stands in the order of the rules");
  switch (what) {
  case vehicle_class::multirotor:
    return found.multirotor;
  case vehicle_class::fixed_wing:
    return mission_has_land_start ? found.fixed_wing_with_land_start : found.fixed_wing;
  case vehicle_class::rover:
    return found.rover;
  case vehicle_class::unknown:
    break;
  }
  return std::nullopt;
}

bool is_done_by(action wanted, mode_kind mode) {
  switch (wanted) {
  case return_home:
    return mode == mode_kind::returning || mode == mode_kind::landing;
  case land:
  case do_land_start: // by its mode alone nobody can tell that it is at the landing of its plan
    return mode == mode_kind::landing;
  case hold:
    break;
  }
  return mode == mode_kind::hold;
}

std::array<mode_kind, 2> modes_of(action wanted) {
  switch (wanted) {
  case return_home:
    return {mode_kind::returning, mode_kind::landing};
  case land:
    return {mode_kind::landing, mode_kind::landing};
  case do_land_start:
    return {mode_kind::mission, mode_kind::landing};
  case hold:
    break;
  }
  return {mode_kind::hold, mode_kind::hold};
}

} // namespace godwit::failsafe
