// One plan while it is being written: its vehicle items, which item of the mission they belong to, and the way.
//
// A speed that was asked for in an earlier part of the mission is owed: it is said again in front of the first item
// that flies on, because vehicles forget it when a plan is replaced or they land. Take-offs come before it. Thread: one
// owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/plan/setting.hpp"
#include "messages/mission/place.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::executor::plan {

class plan_writer {
public:
  // START: where the vehicle is then; SPEED: what is owed.
  plan_writer(const plan_setting& setting, const mission::position& start, bool is_under_way,
              std::optional<double> speed_mps);

  // What follows belongs to this item of the mission.
  void begin_item(const std::string& id, std::uint32_t index);

  void set_speed(double mps);
  void add_take_off(const io::mavlink::mission_item_int& item);
  void add_nav(const io::mavlink::mission_item_int& item);
  void mark_landing();
  // As it came; what becomes of it says ROLE. One that lands or moves nowhere needs no leg.
  void add_verbatim(const io::mavlink::mission_item_int& item, progress::item_role role);
  // A command that an earlier part of the mission has given, in front of the item that is written now.
  void repeat(const io::mavlink::mission_item_int& item) { append(item); }
  // To the first vehicle item of the item called TO, which may come later.
  void add_jump(const io::mavlink::mission_item_int& item, const std::string& to);
  // The way of a jump, from here; the vehicle is still here after the last one.
  void jump_to(const mission::position& to);
  // What follows comes after a landing and is no flight of its own: the vehicle keeps it, and nobody begins it.
  void begin_branch();
  // What is written before the first item of a plan that begins at item INDEX, within a loop, belongs to no item.
  void begin_lead_in(std::uint32_t index) { lead_in_item_ = index; }
  // On to the item called ENTRY, which comes after those that the loop leads back to.
  void end_lead_in(const std::string& entry);
  void note(std::string sentence) { plan_.notes.push_back(std::move(sentence)); }
  // After it come its lines.
  void begin_survey(std::uint32_t lines_before, std::uint16_t items_per_line, std::uint16_t items_after_line);
  void end_survey();
  // The item that is written now goes on with a line on which so many pictures were taken before.
  void continue_line(const mission::picture_count& before);

  void climb_to(double altitude_m);
  void cruise_to(const mission::position& to);
  void circle(double radius_m);
  // Ends the flight; an altitude above the vehicle's own ends it too.
  void descend_to(const mission::position& to);
  // It stands: a rover at the end of its way.
  void stop() { ends_on_ground_ = true; }

  [[nodiscard]] const mission::position& here() const { return here_; }
  [[nodiscard]] const mission::position& start() const { return start_; }
  [[nodiscard]] bool began_under_way() const { return began_under_way_; }
  [[nodiscard]] bool is_in_air() const { return is_in_air_; }
  [[nodiscard]] bool has_moved() const { return navs_ > 0; }
  // The last of these was a place in the air, from which a fixed wing can come down.
  [[nodiscard]] bool comes_from_a_place() const { return comes_from_a_place_; }
  [[nodiscard]] bool ends_on_ground() const { return ends_on_ground_; }
  [[nodiscard]] bool is_branch() const { return is_branch_; }
  [[nodiscard]] std::optional<double> speed_mps() const { return speed_mps_; }
  [[nodiscard]] std::size_t size() const { return plan_.items.size(); }

  // Items of the mission that follow the end of the plan and have nothing to fly.
  void take_over(const progress::plan_map& idle);
  // The id of an item that a jump of this plan leads to, and that is not in it. Nothing: none.
  [[nodiscard]] std::optional<std::string> missing_target() const;
  // Only of a plan that moves the vehicle, and whose jumps lead to items of it.
  [[nodiscard]] flight_plan finished() const;
  [[nodiscard]] const progress::plan_map& map() const { return plan_.map; }

private:
  void append(const io::mavlink::mission_item_int& item);
  [[nodiscard]] std::uint32_t item_index() const;
  void go(leg_kind kind, const mission::position& to);
  void pay_speed();
  void trigger_by_distance(double distance_m, bool at_once);

  const plan_setting& setting_;
  mission::position start_;
  mission::position here_;
  bool began_under_way_;
  bool is_in_air_;
  bool comes_from_a_place_ = false;
  bool ends_on_ground_ = false;
  bool owes_speed_;
  std::optional<double> speed_mps_;
  std::size_t navs_ = 0;
  bool is_branch_ = false;
  double trigger_m_ = 0;               // of a camera that triggers by distance; 0: it does not
  double held_back_s_ = 0;             // by conditions, at most: the commands up to the next place
  std::uint32_t pictures_at_once_ = 0; // taken where it was switched on, since the last way
  bool is_triggering_ = false;         // it triggers by time
  bool skips_leg_ = false;             // its next place is not flown to from here
  mission::position landed_at_;
  struct planned_jump {
    std::uint16_t sequence;
    std::uint32_t item_index; // in the mission
    std::string to;           // the id of an item
    double times;             // below 0: for ever
  };
  struct loop_entry {
    std::string item_id;
    std::optional<std::uint16_t> jump_sequence; // none: the vehicle begins there
  };
  struct item_loop { // by indices in the mission
    std::uint32_t first;
    std::uint32_t jump;
    double taken;
  };
  void lead_in(flight_plan& plan) const;
  [[nodiscard]] static double rounds_of(const flight_plan& plan, std::span<const item_loop> loops,
                                        std::uint32_t item_index);
  void count_rounds(flight_plan& plan, std::span<const item_loop> loops) const;
  [[nodiscard]] std::vector<double> leg_lengths() const;
  [[nodiscard]] std::int64_t round_ns(const item_loop& loop, std::span<const double> lengths_m) const;
  void lead_jumps(flight_plan& plan) const;

  std::vector<planned_jump> jumps_;
  std::uint32_t lead_in_item_ = 0;
  std::optional<loop_entry> entry_;
  std::size_t lead_in_legs_ = 0; // the first so many
  flight_plan plan_;
};

} // namespace godwit::executor::plan
