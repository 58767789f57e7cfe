// On the ground: from the link to a plan that is ready.
//
// The checks run once a second while the flight is prepared, and build the plans on the way. Pure. Thread: one at a
// time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/flight/service_view.hpp"
#include "actors/executor/flight/task_control.hpp"
#include "actors/executor/flight/watches/energy_control.hpp"
#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/report.hpp"

namespace godwit::executor {

// What of this process the preflight checks look at; asked for by the shell.
struct host_status {
  preflight::journal_facts journal;
  std::vector<preflight::actor_fact> actors;
  preflight::operator_fact operators;
  preflight::camera_fact camera;
  preflight::program_fact program;
};

class preparation {
public:
  preparation(flight_context& flight, phase_machine& phases, task_control& tasks, const energy_control& energy,
              const service_view& service)
      : flight_(flight), phases_(phases), tasks_(tasks), energy_(energy), service_(service) {}

  enum class result {
    nothing,
    under_way, // the rest waits
    ready      // the plan is there, and the checks have just passed
  };
  [[nodiscard]] result advance(effects& out, instant now);
  // The sentence says why the flight may not be started now; empty: it may.
  [[nodiscard]] std::string why_not_start(effects& out, instant now);

  // What this incarnation found last; for people.
  [[nodiscard]] const std::optional<preflight::dated_report>& last_look() const { return last_look_; }

  void on_host_status(host_status seen);
  void check_again() { wants_checks_ = true; }
  void acknowledge(preflight::acknowledged what) { acknowledged_ = std::move(what); }

private:
  [[nodiscard]] preflight::report look_at_all(instant now);
  [[nodiscard]] preflight::vehicle_facts look_at_vehicle(instant now) const;
  [[nodiscard]] std::optional<preflight::planned_home_fact> compare_planned_home(const mission::document& mission,
                                                                                 const plan::plan_setting& where);
  [[nodiscard]] std::string why_no_mission() const; // empty: nobody said
  [[nodiscard]] bool take_arrived(effects& out);
  void warn_of_straight_return(effects& out) const;
  // Why what is left of a mission that was begun can not be flown from where the vehicle stands; empty: it can, or that
  // is not known.
  [[nodiscard]] std::string why_rest_refused() const;
  [[nodiscard]] result check(effects& out, instant now);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  const energy_control& energy_;
  const service_view& service_;
  bool wants_checks_ = false;
  std::optional<preflight::acknowledged> acknowledged_;
  std::optional<preflight::plan_result> plans_;  // of the mission, from its first remaining item on
  std::vector<plan::return_crossing> crossings_; // of these plans, by a straight return
  std::optional<preflight::planned_home_fact> planned_home_;
  std::int64_t checked_ns_ = 0;
  host_status host_status_;
  std::optional<preflight::dated_report> last_look_;
};

} // namespace godwit::executor
