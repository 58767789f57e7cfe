// How the actors are joined to the world: what may fail for good comes first; a line that can not be opened is told,
// and the rest goes on without it.
#include "programs/godwitd/composition.hpp"

#include <utility>

#include "actors/executor/state.hpp"
#include "programs/godwitd/child_policies.hpp"
#include "programs/godwitd/open_line.hpp"

namespace godwit::daemon {

tl::expected<void, std::string> composition::open() {
  // What may fail comes first; mail waits at the addresses until the actors are there.
  if (auto opened = open_map(); !opened)
    return opened;
  if (auto opened = open_control(); !opened)
    return opened;
  if (service_) // before the first call can be answered
    service_->attach(host_->actors().make_gateway("missions_service"), base_.client);
  using executor::supervision::part;
  if (wanted_.flies)
    begin_supervision(host_->actors(), outside_.process, is_in_flight() ? part::flight : part::ground);
  tell_open_lines();
  if (broker_)
    broker_->attach(host_->actors().make_gateway("broker_port"), views_.fleet);
  if (eyes_port_)
    eyes_port_->open(host_->actors().make_gateway("eyes_port"), flight_.eyes);
  if (trial_eyes_)
    trial_eyes_->attach(
        {[to = camera_trial_.get()](std::uint32_t run, const io::eyes::message& said) { to->on_message(run, said); },
         [to = camera_trial_.get()](std::uint32_t run, const std::string& why) { to->on_end(run, why); }});
  open_link_log();
  host_->actors().start();
  open_vehicle();
  if (wanted_.flies)
    open_ground();
  if (wanted_.operators)
    operators_.open(*host_, *wanted_.operators, views_outside_, views_,
                    {eyes_, point_pictures_, keeper_.get(), outside_.session_ends},
                    [this](const std::string& sentence, bool is_warning) {
                      announce({sentence, is_warning}, "operator_port");
                    });
  open_feed();
  open_accounts();
  hand_over_mission();
  return {};
}

void composition::tell_open_lines() {
  const auto tell = [this](const std::string& sentence, std::string_view part) {
    if (!sentence.empty())
      announce({sentence, true}, part);
  };
  tell(open_line_warning(wanted_.vehicle, !wanted_.signing_key_file.empty(), "--signing-key"), "vehicle_link");
  if (wanted_.flies && wanted_.ground)
    tell(open_line_warning(*wanted_.ground, !wanted_.ground_key_file.empty(), "--ground-signing-key"), "ground_port");
}

tl::expected<void, std::string> composition::open_map() {
  if (auto opened = map_port_->open(wanted_.map, host_->actors().make_gateway("map_writer"), base_.store); !opened)
    return tl::make_unexpected(opened.error().message());
  return {};
}

tl::expected<void, std::string> composition::open_control() {
  const auto way_in = std::make_shared<runtime::gateway>(host_->actors().make_gateway("control_socket"));
  auto opened = control::server::open(wanted_.control_path, control_answers_,
                                      [way_in, request_handler = request_handler_](control::control_request asked) {
                                        way_in->tell(request_handler, std::move(asked));
                                      });
  if (!opened)
    return tl::make_unexpected(std::move(opened.error()));
  control_ = *std::move(opened);
  return {};
}

// Links that can not be recorded are no reason not to use them.
void composition::open_link_log() {
  if (!wanted_.link_log)
    return;
  auto opened = link_log::open(*wanted_.link_log, host_->journal().status().run, host_->time(), host_->health());
  if (!opened) {
    announce({opened.error(), true}, "link_log");
    return;
  }
  link_log_ = *std::move(opened);
  vehicle_port_->set_tap(link_log_->tap(recorded_link::vehicle));
  ground_line_->set_tap(link_log_->tap(recorded_link::ground));
  link_log_->start();
}

// A vehicle that can not be reached is no reason to keep what is owed to the service.
void composition::open_vehicle() {
  if (const auto opened =
          vehicle_port_->open(wanted_.vehicle, {}, host_->actors().make_gateway("vehicle_port"), base_.vehicle);
      !opened)
    announce({"the link to the vehicle can not be opened: " + opened.error() +
                  "\ngodwitd goes on without a vehicle; mend it and start godwitd again",
              true},
             "vehicle_link");
}

void composition::open_feed() {
  if (wanted_.sightings_file.empty())
    return;
  const auto way_in = std::make_shared<runtime::gateway>(host_->actors().make_gateway("sighting_feed"));
  feed_->start(
      [this, way_in] {
        if (wanted_.flies)
          way_in->tell(flight_.feeder, sightings::woken{});
        else
          way_in->tell(run_, ground_run::woken{});
      },
      [this](const std::string& sentence) {
        announce({sentence, true}, "sighting_feed");
      });
}

void composition::open_accounts() {
  if (!keeper_)
    return;
  const auto way_in = std::make_shared<runtime::gateway>(host_->actors().make_gateway("accounts"));
  keeper_->start([way_in, bridge = flight_.bridge](const auto& all) { way_in->tell(bridge, all); },
                 [this](const std::string& sentence) {
                   announce({sentence, true}, "accounts");
                 });
}

// A line that can not be opened is no reason not to fly.
void composition::open_ground() {
  if (!wanted_.ground)
    return;
  if (const auto opened =
          ground_line_->open(*wanted_.ground, {}, host_->actors().make_gateway("ground_line"), flight_.ground);
      !opened)
    announce({"the line for ground stations can not be opened: " + opened.error() +
                  "\ngodwitd goes on without them; mend it and start godwitd again",
              true},
             "ground_port");
}

// The mission of a file is told to whoever flies it, as the service's would be.
void composition::hand_over_mission() {
  if (!wanted_.flies || !file_mission_)
    return;
  mission_client::mission_loaded loaded;
  loaded.document = *file_mission_;
  host_->actors().make_gateway("mission_file").tell(flight_.executor, loaded);
}

} // namespace godwit::daemon
