// All of godwitd's parts, made in one place and joined there. What they are: daemon.hpp.
//
// Errors: sentences for people, with what to do. Thread: one owner.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "actors/fleet_link/mqtt_port.hpp"
#include "actors/ground_port/link_port.hpp"
#include "actors/mapobjects_store/map_port.hpp"
#include "actors/mission_client/http_service.hpp"
#include "actors/movement_detector/eyes_process.hpp"
#include "actors/vehicle_link/link_port.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission_client/handle.hpp"
#include "programs/godwitd/accounts/account_keeper.hpp"
#include "programs/godwitd/audit_reader.hpp"
#include "programs/godwitd/camera_trial.hpp"
#include "programs/godwitd/control/request_handler.hpp"
#include "programs/godwitd/control/server.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/ground_run/actor.hpp"
#include "programs/godwitd/host_facts.hpp"
#include "programs/godwitd/link_log/link_log.hpp"
#include "programs/godwitd/log/program_log.hpp"
#include "programs/godwitd/operator_access.hpp"
#include "programs/godwitd/settings.hpp"
#include "programs/godwitd/sightings/point_pictures.hpp"
#include "programs/godwitd/sightings/sighting_feed.hpp"
#include "programs/godwitd/view_actors.hpp"

namespace godwit::daemon {

// Why the run ended, as the first who ended it says. Thread: any.
class run_end {
public:
  struct outcome {
    bool well = true;
    std::string why; // a sentence for people; empty when all is well
  };

  void set(outcome how) {
    const std::lock_guard guard(mutex_);
    if (!first_)
      first_ = std::move(how);
  }
  // Nothing: it was ended from outside.
  [[nodiscard]] std::optional<outcome> get() const {
    const std::lock_guard guard(mutex_);
    return first_;
  }

private:
  mutable std::mutex mutex_;
  std::optional<outcome> first_;
};

class composition {
public:
  // Opens files, and starts nothing. LOG outlives it.
  [[nodiscard]] static tl::expected<std::unique_ptr<composition>, std::string> make(daemon_settings wanted,
                                                                                    program_log& log);
  composition(const composition&) = delete;
  composition& operator=(const composition&) = delete;
  ~composition() = default;

  // As the journal says, before the actors start.
  [[nodiscard]] bool is_in_flight();
  // How this process begins, and may end; before open().
  void set_circumstances(const executor::supervision::circumstances& process) { outside_.process = process; }
  // Starts the actors and joins them to the world. After an error: close().
  [[nodiscard]] tl::expected<void, std::string> open();

  // The certificate of the operators' port. Any thread.
  void read_anew() { operators_.read_certificate_anew(); }

  // In order; returns CODE.
  [[nodiscard]] int close(runtime::exit_code code);

  [[nodiscard]] runtime::process& host() { return *host_; }
  // None without a service.
  [[nodiscard]] const mission_client::own_handle& client() const { return base_.client; }
  [[nodiscard]] const std::string& mission_id() const { return wanted_.mission_id; }
  [[nodiscard]] std::optional<run_end::outcome> end_of_run() const { return end_.get(); }

private:
  composition(daemon_settings wanted, program_log& log);

  [[nodiscard]] tl::expected<void, std::string> open_files();
  [[nodiscard]] tl::expected<void, std::string> load_mission();
  [[nodiscard]] bool reads_in_flight();
  void surround_actors();
  void surround_views();
  void add_actors();
  void add_flight(control::peers& of_handler);
  void add_ground_run(control::peers& of_handler);
  [[nodiscard]] audit_source audit_of_journal();
  void open_link_log();
  void open_vehicle();
  void open_ground();
  [[nodiscard]] tl::expected<void, std::string> check_operators();
  // Numbers of points of interest that the camera has shown; empty: there is no camera.
  [[nodiscard]] std::function<std::vector<std::uint64_t>()> pictured_points() const;
  [[nodiscard]] health::host_figures read_host();
  void open_feed();
  [[nodiscard]] tl::expected<void, std::string> make_eyes();
  void open_accounts();
  void hand_over_mission();
  [[nodiscard]] tl::expected<void, std::string> open_map();
  void tell_open_lines();
  [[nodiscard]] tl::expected<void, std::string> open_control();
  [[nodiscard]] ground_run::run_world world_of_run();
  [[nodiscard]] ground_run::settings settings_of_run() const;
  // PART: of whom it is said.
  void announce(const ground_run::announce& said, std::string_view part = "ground_run");

  std::int64_t began_ms_ = 0;         // since 1970 (UTC)
  std::optional<bool> was_in_flight_; // none: the journal was not asked yet
  daemon_settings wanted_;
  program_log& log_;
  run_end end_;
  std::optional<mission::document> file_mission_; // none with a service

  std::shared_ptr<sighting_feed> feed_;                        // none without sightings
  std::shared_ptr<mission_client::http_service> service_;      // none without a service
  std::shared_ptr<io::eyes::helper> eyes_;                     // none without a camera
  std::shared_ptr<movement_detector::eyes_process> eyes_port_; // the same
  std::shared_ptr<point_pictures> point_pictures_;             // the same
  std::shared_ptr<io::eyes::helper> trial_eyes_;               // the same; of the trial before the flight
  std::shared_ptr<camera_trial> camera_trial_;                 // the same
  std::shared_ptr<fleet_link::mqtt_port> broker_;              // none without one
  std::shared_ptr<vehicle_link::link_port> vehicle_port_ = std::make_shared<vehicle_link::link_port>();
  std::shared_ptr<mapobjects_store::map_port> map_port_ = std::make_shared<mapobjects_store::map_port>();
  std::shared_ptr<ground_port::link_port> ground_line_ = std::make_shared<ground_port::link_port>();
  std::shared_ptr<control::response_queue> control_answers_;

  std::unique_ptr<host_facts> facts_;
  actor_surroundings outside_;
  std::unique_ptr<audit_reader> audit_;    // with a flight; after the journal has opened
  std::unique_ptr<runtime::process> host_; // ends before what its actors meet
  std::unique_ptr<link_log> link_log_;     // none: the links are not recorded
  base_actors base_;
  ground_run::own_handle run_; // of a run on the ground
  flight_actors flight_;       // else
  view_surroundings views_outside_;
  view_actors views_;
  control::request_handle request_handler_;

  std::unique_ptr<accounts::account_keeper> keeper_; // with a flight
  std::unique_ptr<control::server> control_;
  operator_access operators_{wanted_.operators && wanted_.operators->uses_tls};
};

} // namespace godwit::daemon
