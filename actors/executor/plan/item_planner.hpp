// What one item of a mission is for a vehicle.
//
// | Item         | Multirotor                      | Fixed wing                       | Rover                      |
// |--------------|---------------------------------|----------------------------------|----------------------------|
// | takeoff      | NAV_TAKEOFF where it stands     | NAV_TAKEOFF towards the next     | none: it need not rise     |
// |              |                                 | place; none in the air           |                            |
// | waypoint     | [speed] NAV_WAYPOINT with hold  | the same; with a hold            | [speed] NAV_WAYPOINT       |
// |              |                                 | NAV_LOITER_TIME                  | with hold                  |
// | loiter       | NAV_LOITER_TIME: it hovers      | NAV_LOITER_TIME: it circles      | NAV_WAYPOINT with hold     |
// | change_speed | DO_CHANGE_SPEED over ground     | through the air                  | over ground                |
// | survey       | 2 NAV_WAYPOINT for each line    | the same                         | the same                   |
// | land         | NAV_LAND                        | NAV_LAND, after a place that is  | NAV_WAYPOINT: it drives    |
// |              |                                 | higher and not too steep         | there and stops            |
// | return       | NAV_RETURN_TO_LAUNCH            | the same; it circles or lands as | NAV_RETURN_TO_LAUNCH       |
// |              |                                 | its own settings say             |                            |
// | ... when the | NAV_WAYPOINT over the return    | refused                          | NAV_WAYPOINT at the return |
// | return point | point, NAV_LAND                 |                                  | point                      |
// | is not home  |                                 |                                  |                            |
// | return to    | NAV_RETURN_TO_LAUNCH wherever   | the same                         | the same                   |
// | HOME         | the vehicle's home is           |                                  |                            |
// | command      | as it came, if the table of commands lets a mission hold it and this vehicle does not refuse it | |
// jump         | DO_JUMP to the first vehicle item of its target                                                      |
//
// Home moves to where a vehicle arms. So the return point is home only if the flight began there; the return from a
// delivery is said in places, unless it is one to HOME. Landing or returning where the vehicle stands already is
// nothing to do. A rover has no altitudes: what a mission says of them goes to the vehicle as it is, and is not looked
// at. Multirotors and fixed wings that stand on the ground begin with a take-off, and none comes in the middle of a
// flight. Some numbers are requests that a vehicle may not know: the radius of arrival (ArduPilot's multirotors and
// rovers have their own), and the radius of a circle for those who hover. Thread: one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "actors/domain/mission/commands/command_table.hpp"
#include "actors/executor/plan/plan_error.hpp"
#include "actors/executor/plan/plan_writer.hpp"
#include "actors/executor/plan/setting.hpp"
#include "actors/executor/plan/survey/survey_lines.hpp"
#include "actors/executor/progress/state.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

// As near as this is the same place: positions of home differ by some metres from one arming to the next.
inline constexpr double same_place_m = 10;
// A fixed wing takes off towards a place; one that is nearer tells no direction.
inline constexpr double min_take_off_way_m = 20;
// No plane comes down more steeply without special equipment. PX4's own limit is 5 degrees (FW_LND_ANG) unless changed.
inline constexpr double max_glide_slope_deg = 15;
// An ArduPilot plane circles for a time with its own radius only; one that is asked for may differ by this.
inline constexpr double same_radius_m = 1;

class item_planner {
public:
  item_planner(const mission::document& mission, const plan_setting& setting, plan_writer& writer)
      : mission_(mission), setting_(setting), writer_(writer) {}

  // Writes item INDEX of the mission, without the first LINES_BEFORE of its lines if it is a survey. The error says why
  // it can not be said to this vehicle; the plan is of no use then.
  [[nodiscard]] std::optional<plan_error> write(std::size_t index, std::uint32_t lines_before);

  // What a plan needs that begins at item INDEX, within a loop, before the items that the loop leads back to: the
  // take-off, and what was set before.
  [[nodiscard]] std::optional<plan_error> lead_in(std::size_t index);

  // How often the vehicle has taken the jumps of the mission.
  void count_jumps(std::span<const progress::taken_jump> taken) { taken_ = taken; }

  // From now on the item that is written next takes off first, in its own name: the flight that it belongs to was
  // broken off, and the vehicle stands on the ground. For multirotors, which need no runway.
  void take_off_again(double altitude_m) { take_off_first_m_ = altitude_m; }

  // The plan begins at item FIRST, and the vehicle may have lost what the items before it have set. The first item that
  // moves it in the air is preceded by that. True: it was.
  void repeat_state_of(std::size_t first) { rest_from_ = first; }
  [[nodiscard]] bool has_repeated_state() const { return has_repeated_; }

  // If the item that is written next is that line, it goes on where its last picture was taken.
  void continue_line(const progress::begun_line& line) { line_ = &line; }

private:
  using outcome = std::optional<plan_error>;

  outcome plan(const mission::takeoff& item);
  outcome plan(const mission::waypoint& item);
  outcome plan(const mission::loiter& item);
  outcome plan(const mission::change_speed& item);
  outcome plan(const mission::survey& item);
  outcome plan(const mission::land& item);
  outcome plan(const mission::return_home& item);
  outcome plan(const mission::command_item& item);
  outcome plan(const mission::jump& item);

  // Of a command that the vehicle executes and that moves it: its way, and the item.
  outcome move(const mission::command_item& item);
  outcome take_off(const mission::command_item& item);
  outcome go_to(const mission::command_item& item);
  [[nodiscard]] outcome why_not_command(const mission::command_item& item) const;
  [[nodiscard]] mission::item_answer answer_to(const mission::command_item& item) const;
  // Where it leads; none: here.
  [[nodiscard]] std::optional<mission::position> position_of(const mission::item& item) const;
  void take_off_first();
  void repeat_or_leave_line();
  void repeat_state();
  void leave_line();
  bool lead_in_to_line(std::size_t begin);
  // The line that the item continues; null: it continues none.
  [[nodiscard]] const progress::begun_line* line_of_item() const;
  [[nodiscard]] outcome fly_line(const mission::survey& item, const survey_line& line);

  outcome return_by_places(const mission::position& goal);
  void return_by_itself(const mission::position& goal);

  [[nodiscard]] outcome why_not_flown() const;
  [[nodiscard]] outcome why_not_there(const mission::position& at) const;
  [[nodiscard]] outcome why_not_waited(double seconds) const;
  // All three, in this order.
  [[nodiscard]] outcome why_not_reached(const mission::position& at, double wait_s) const;
  [[nodiscard]] outcome why_not_glided(const mission::position& to) const;
  [[nodiscard]] outcome error(plan_errc code, std::string what, std::string remedy) const;

  [[nodiscard]] bool is(vehicle_class one) const { return setting_.vehicle == one; }
  // It stands there, and has not moved since.
  [[nodiscard]] bool stands_at(const mission::position& at) const;
  [[nodiscard]] bool is_home(const mission::position& goal) const;
  [[nodiscard]] double take_off_altitude_m(double asked_m) const;

  const mission::document& mission_;
  const plan_setting& setting_;
  plan_writer& writer_;
  std::size_t index_ = 0;
  std::uint32_t lines_before_ = 0;
  std::span<const progress::taken_jump> taken_;
  std::optional<double> take_off_first_m_;
  std::optional<std::size_t> rest_from_;
  bool has_repeated_ = false;
  const progress::begun_line* line_ = nullptr;
};

} // namespace godwit::executor::plan
