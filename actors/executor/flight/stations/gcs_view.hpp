// What ground stations upload, start and clear, and what they are shown of the mission. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/mission/convert/item_list_import.hpp"
#include "actors/executor/flight/stations/plan_clearing.hpp"
#include "actors/executor/flight/stations/upload_in_flight.hpp"
#include "actors/executor/flight/stations/upload_on_ground.hpp"
#include "actors/executor/flight/watches/control_watch.hpp"
#include "messages/executor/types.hpp"
#include "messages/ground_port/mission.hpp"

namespace godwit::executor {

class gcs_view {
public:
  gcs_view(flight_context& flight, phase_machine& phases, task_control& tasks, control_watch& watch,
           plan_clearing& clearing)
      : flight_(flight), phases_(phases), tasks_(tasks), watch_(watch), clearing_(clearing), uploads_(flight, tasks),
        on_ground_(flight, phases) {}

  // Answered with plan_judged to the port.
  [[nodiscard]] effects on_plan(const plan_taken& m, bool has_looked, instant now);
  [[nodiscard]] effects on_cleared(const plan_cleared& m, bool has_looked, instant now);
  [[nodiscard]] effects on_start(const start_mission& m, instant now);
  // What stations are to be told, when it has changed and once a second.
  [[nodiscard]] effects tell(instant now);
  // The vehicle has, or has not, the plan of the mission.
  void on_transfer(const vehicle_link::transfer::outcome& outcome) { on_ground_.on_transfer(outcome); }
  // True: what follows is decided when it is applied.
  [[nodiscard]] bool look(effects& out, instant now) { return on_ground_.look(out, now); }
  // The durable state has changed.
  void forget_shown() { shown_.reset(); }
  // Why the last upload of a station was not taken; empty: it was, or there was none.
  [[nodiscard]] const std::string& refused_upload() const { return refused_upload_; }
  // ground_port has lost what it was told.
  void forget_told() { told_plan_id_ = 0; }

private:
  struct shown_plan {
    std::uint32_t plan_id = 0; // 0: none
    std::size_t items = 0;
    bool is_upload = false; // as it came; else as the vehicle has it
  };
  [[nodiscard]] const shown_plan& shown();
  using verdict = ground_port::plan_verdict;
  [[nodiscard]] verdict take(effects& out, const plan_taken& m, bool has_looked, instant now);
  [[nodiscard]] bool counts(const plan_taken& m) const; // it is the one here
  [[nodiscard]] verdict take_plan(effects& out, const plan_taken& m, bool has_looked, instant now);
  [[nodiscard]] std::string why_no_plan(const plan_taken& m, bool has_looked) const; // is taken; empty: it may be
  [[nodiscard]] tl::expected<mission::imported_list, mission::conversion_error> import_plan(const plan_taken& m,
                                                                                            instant now) const;
  [[nodiscard]] effects take_fence(const std::vector<io::mavlink::mission_item_int>& items);
  [[nodiscard]] effects take_rally(const std::vector<io::mavlink::mission_item_int>& items);
  [[nodiscard]] effects not_taken(const std::string& why);
  [[nodiscard]] std::string why_not_meant(const start_mission& m);
  void hand_back();
  [[nodiscard]] bool fly_again(effects& out, const start_mission& m, instant now);
  [[nodiscard]] bool begins_with_home(const std::vector<io::mavlink::mission_item_int>& items) const;

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  control_watch& watch_;
  plan_clearing& clearing_;
  upload_in_flight uploads_;
  upload_on_ground on_ground_;
  std::optional<shown_plan> shown_;
  std::uint32_t told_plan_id_ = 0;
  std::string refused_upload_; // why the last upload of a station was not taken; empty: it was
  ground_port::mission_progress told_progress_;
  std::int64_t told_progress_ns_ = 0;
};

} // namespace godwit::executor
