// The run on the ground as an actor: stands in the place of what flies the mission, listens to mission_client, and
// feeds the sightings to the map store.
//
// The course is core.hpp's, the flow of the sightings sighting_flow's. Nothing of it is durable: see core.hpp. Errors:
// told to people, or the end of the run. Thread: as actor_base.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "messages/mapobjects_store/handle.hpp"
#include "programs/godwitd/ground_run/messages.hpp"
#include "programs/godwitd/sightings/sighting_flow.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::ground_run {

using vehicle_handle = runtime::mailbox<runtime::asks<vehicle_link::get_connection, vehicle_link::connection>>;

// Filled in while the process is composed, before the actors start.
struct peers {
  vehicle_handle vehicle;
  mission_client::flight_handle client; // none without a service
  mapobjects_store::handle store;
};

// The world outside of the actors. Both may be called by any thread and do not block.
struct run_world {
  std::function<void(const announce& said)> tell_people;
  std::function<void(const finish& how)> end;
};

class actor final : public runtime::actor_base<own_handle> {
public:
  static constexpr std::chrono::seconds tick_period{1};
  static constexpr std::chrono::seconds answer_timeout{10};

  // FEED: null without sightings.
  actor(runtime::spawn_context context, settings wanted, std::shared_ptr<const peers> others,
        std::shared_ptr<daemon::sighting_feed> feed, run_world world);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;

private:
  void execute(const steps& wanted);
  void execute(const begin_fetch&);
  void execute(const choose&);
  void execute(const look&);
  void execute(const see&);
  void execute(const push&);
  void execute(const count_owed&);
  void execute(const begin_later&);
  void execute(const announce& said) { world_.tell_people(said); }
  void execute(const finish& how) { world_.end(how); }

  [[nodiscard]] daemon::sighting_flow::ways ways_of_flow();
  void look_again();
  void look_at_vehicle();
  void turn_down(const mission_client::assignment_arrived& wanted);

  std::string mission_id_;
  bool has_service_;
  core core_;
  std::shared_ptr<const peers> others_;
  std::shared_ptr<daemon::sighting_feed> feed_;
  run_world world_;
  std::optional<std::int64_t> loaded_ns_;     // in this run
  std::optional<daemon::sighting_flow> flow_; // from started() on
  bool wants_owed_ = false;                   // the store did not say what is left
  bool has_news_of_vehicle_ = false;
};

} // namespace godwit::ground_run
