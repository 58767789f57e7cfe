// Which item of the mission each item on the vehicle belongs to.
//
//   vehicle sequence   0        1        2        3        4        5
//   command            TAKEOFF  SPEED    WAYPOINT WAYPOINT WAYPOINT RETURN
//   mission item       t        └─ w1 ──────┘     └─ survey ──┘     home
//
// A mission item becomes none, one or several vehicle items; a plan may be a part of a mission, and its indices are
// those of the mission. Sequences are as the vehicle counts: PX4 from 0, ArduPilot from 1, because its 0 is home. A
// map comes from our own planner; whoever takes one asserts is_sound(). Thread: plain values, pure functions. Source:
// MISSION_CURRENT (42), MISSION_ITEM_REACHED (46).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::executor::progress {

// What becomes of an item that the vehicle has left.
enum class item_role {
  flown,  // it was reached
  acts,   // it was passed: that the act succeeded is another matter
  unflown // the vehicle keeps it and does not execute it
};

GODWIT_ENUM_NAMES(item_role, flown, acts, unflown);

// What of an item the vehicle, or its camera, reports beside that it goes on.
enum class act_kind {
  none,
  release, // of the gripper's load
  grab,
  placement, // of a load on the ground
  picture    // a single one
};

GODWIT_ENUM_NAMES(act_kind, none, release, grab, placement, picture);

struct mapped_item {
  std::string item_id;
  std::uint32_t item_index = 0;     // in the mission's items, from 0 on
  std::uint16_t first_sequence = 0; // without vehicle items: that of what follows it
  std::uint16_t sequence_count = 0; // 0: the vehicle has nothing to do for it
  // The first and the last of its vehicle items that move the vehicle (NAV commands). Absent: it moves nothing.
  std::optional<std::uint16_t> first_nav_sequence;
  std::optional<std::uint16_t> last_nav_sequence;
  item_role role = item_role::flown;
  act_kind act = act_kind::none;
  std::uint32_t act_late_s = 0; // so long a condition before it may hold the act back, not beyond the next place
  // That a trigger by distance takes on the way to it, those at both ends of a line included; on so many lines.
  std::uint32_t pictures = 0;
  std::uint16_t lines = 0;
  bool ends_with_picture = false; // the last of them is taken as the vehicle leaves it
  bool continues_line = false;    // the first of them were taken by a plan before

  GODWIT_FIELDS(mapped_item, "executor.progress_mapped_item", item_id, item_index, first_sequence, sequence_count,
                first_nav_sequence, last_nav_sequence, role, act, act_late_s, pictures, lines, ends_with_picture,
                continues_line);
  friend bool operator==(const mapped_item&, const mapped_item&) = default;
};

// A jump that leads back: the vehicle goes from the item before JUMP_SEQUENCE to TARGET_SEQUENCE.
struct plan_loop {
  std::uint16_t target_sequence = 0;
  std::uint16_t jump_sequence = 0;
  std::int64_t round_ns = 0; // no vehicle flies a round in less; 0: a single place, whose rounds nobody sees
  bool counts_anew = false;  // the vehicle forgets the count as it leaves the loop (ArduPilot)

  GODWIT_FIELDS(plan_loop, "executor.progress_plan_loop", target_sequence, jump_sequence, round_ns, counts_anew);
  friend bool operator==(const plan_loop&, const plan_loop&) = default;
};

// How often the vehicle has taken a jump of the mission that leads back.
struct taken_jump {
  std::string item_id;
  std::uint32_t taken = 0;
  bool is_certain = true; // nobody has listened for as long as a round may take: it may be more
  GODWIT_FIELDS(taken_jump, "executor.progress_taken_jump", item_id, taken, is_certain);
  friend bool operator==(const taken_jump&, const taken_jump&) = default;
};

struct plan_map {
  std::uint16_t first_sequence = 0;  // 1 where item 0 is home
  std::uint16_t total = 0;           // items on the vehicle as MISSION_CURRENT.total counts them: without home
  std::uint16_t start_sequence = 0;  // where the vehicle begins
  bool ends_mission = false;         // no further plan of this mission follows
  std::vector<mapped_item> items;    // in the order of the mission
  std::vector<plan_loop> loops = {}; // in the order of their jumps
  // Of a plan that begins within a loop: so many items from the front were flown before, and stand here for the jump
  // that leads back to them.
  std::uint32_t items_before = 0;
  // Where the lead-in ends with a jump, over them. Absent: the vehicle begins there, or at the first item.
  std::optional<std::uint16_t> enters_at = {};

  GODWIT_FIELDS(plan_map, "executor.progress_plan_map", first_sequence, total, start_sequence, ends_mission, items,
                loops, items_before, enters_at);
  friend bool operator==(const plan_map&, const plan_map&) = default;
};

inline constexpr std::size_t max_mapped_items = 10'000; // as many as a mission may have

// MISSION_CURRENT says this number where there is no item, or no plan.
inline constexpr std::uint16_t no_sequence = 65535;

// A plan to which no item of the mission belongs: it leads home, and the mission is over.
[[nodiscard]] inline bool is_way_home(const plan_map& map) { return map.items.empty(); }

// Items in the order of the mission, none twice; sequences in the same order, none twice, all on the vehicle; the start
// is on the vehicle. Vehicle items that belong to no item of the mission are allowed.
[[nodiscard]] bool is_sound(const plan_map& map);

// One after the last sequence.
[[nodiscard]] std::uint16_t end_sequence(const plan_map& map);
[[nodiscard]] bool has_sequence(const plan_map& map, std::uint16_t sequence);

// The last sequence of its items that moves the vehicle. Absent: none does.
[[nodiscard]] std::optional<std::uint16_t> last_movement(const plan_map& map);

// The position in `items` of the one that SEQUENCE belongs to.
[[nodiscard]] std::optional<std::uint32_t> position_at(const plan_map& map, std::uint16_t sequence);

// The sequence with which ITEM is done: its last one that moves the vehicle, or its last one. It has at least one.
[[nodiscard]] std::uint16_t done_sequence(const mapped_item& item);

// A vehicle that is at SEQUENCE has passed ITEM.
[[nodiscard]] bool is_passed(const mapped_item& item, std::uint16_t sequence);

// A vehicle that begins at START is first seen there, or at the first item after it that moves it: what stands before
// that takes no time. Inside of an item of several movements only START itself counts. From a lead-in that ends with a
// jump it is first seen in there, or where the jump leads.
[[nodiscard]] bool is_start(const plan_map& map, std::uint16_t start, std::uint16_t sequence);

// START is in the lead-in, which ends with a jump.
[[nodiscard]] bool is_in_lead_in(const plan_map& map, std::uint16_t start);

// The loop that takes a vehicle from AT back to SEQUENCE, the innermost of several. Nothing: none does.
[[nodiscard]] std::optional<plan_loop> loop_between(const plan_map& map, std::uint16_t at, std::uint16_t sequence);

// A loop goes on after the last movement: it ends the plan only when the vehicle reports so.
[[nodiscard]] bool ends_in_loop(const plan_map& map);

// So many items from the front have to be done until the plan is: all up to the last one that moves the vehicle.
[[nodiscard]] std::uint32_t items_to_finish(const plan_map& map);

} // namespace godwit::executor::progress
