// How the actors are joined to the world: what may fail for good comes first; a line that can not be opened is told,
// and the rest goes on without it.
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>
#include <utility>

#include <sys/eventfd.h>

#include "actors/executor/state.hpp"
#include "io/http/secret_file.hpp"
#include "io/mavlink/signing/key_file.hpp"
#include "programs/godwitd/checks/start_checks.hpp"
#include "programs/godwitd/composition.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/convert_command.hpp"
#include "programs/godwitd/flight_actors.hpp"
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
                  "\ngodwitd goes on without a vehicle; fix it and start godwitd again",
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
                  "\ngodwitd goes on without them; fix it and start godwitd again",
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

// What is opened before there are actors: keys, missions, the service, the camera, accounts, journal and trace.

namespace {

// For the keys of deliveries, which nobody else may ever make.
std::uint64_t fresh_seed() {
  std::random_device source;
  return (std::uint64_t{source()} << 32U) | source();
}

// Without a file the link is not signed.
tl::expected<void, std::string> load_key(const std::string& file, io::mavlink::signing_settings& into) {
  if (file.empty())
    return {};
  auto key = io::mavlink::load_key_file(file);
  if (!key)
    return tl::make_unexpected(key.error().message());
  into.key = std::make_shared<io::mavlink::secret_key>(*std::move(key));
  return {};
}

// Two programs of one build lie in one folder.
std::string beside_this_program(const char* name) {
  std::error_code failed;
  return (std::filesystem::read_symlink("/proc/self/exe", failed).parent_path() / name).string();
}

} // namespace

tl::expected<void, std::string> composition::open_files() {
  if (auto loaded = load_mission(); !loaded)
    return loaded;
  if (auto loaded = load_key(wanted_.signing_key_file, outside_.vehicle_signing); !loaded)
    return loaded;
  if (wanted_.vehicle_line_is_secure)
    io::mavlink::mark_secure(outside_.vehicle_signing);
  if (auto loaded = load_key(wanted_.ground_key_file, outside_.ground_signing); !loaded)
    return loaded;
  if (wanted_.service) {
    if (!wanted_.service->token_file.empty())
      if (const auto token = io::http::load_token(wanted_.service->token_file); !token)
        return tl::make_unexpected(token.error().message());
    auto service = mission_client::http_service::open(*wanted_.service, wanted_.pictures_folder);
    if (!service)
      return tl::make_unexpected(std::move(service.error()));
    service_ = *std::move(service);
  }
  if (!wanted_.sightings_file.empty()) {
    auto feed = sighting_feed::open(wanted_.sightings_file, wanted_.mission_id);
    if (!feed)
      return tl::make_unexpected(std::move(feed.error()));
    feed_ = *std::move(feed);
  }
  if (auto eyes = make_eyes(); !eyes)
    return eyes;
  if (wanted_.flies) {
    auto keeper = accounts::account_keeper::open(wanted_.accounts_file);
    if (!keeper)
      return tl::make_unexpected(std::move(keeper.error()));
    keeper_ = *std::move(keeper);
  }
  io::link::descriptor readable(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!readable.is_open())
    return tl::make_unexpected(std::string("no descriptor is left: ") + std::strerror(errno));
  control_answers_ = std::make_shared<control::response_queue>(std::move(readable));
  wanted_.process.journal.tables = journal_tables();
  wanted_.process.seed = fresh_seed();
  outside_.seed = fresh_seed();
  if (wanted_.process.trace) {
    wanted_.process.trace->about["mission_id"] = wanted_.mission_id;
    wanted_.process.trace->about["seed"] = std::to_string(outside_.seed); // nothing secret is made with it
  }
  auto host = runtime::process::open(wanted_.process);
  if (!host)
    return tl::make_unexpected(std::move(host.error()));
  host_ = *std::move(host);
  began_ms_ = host_->time().wall_ns() / 1'000'000;
  return {};
}

// In flight a file of accounts that is gone is no reason to leave the vehicle alone.
tl::expected<void, std::string> composition::check_operators() {
  if (!wanted_.operators)
    return {};
  const auto objection = operator_port::objection_to(*wanted_.operators, keeper_ && keeper_->has_accounts());
  if (!objection)
    return {};
  if (!is_in_flight())
    return tl::make_unexpected(all_names_of("operator-listen") + ": " + *objection);
  announce({*objection + "\nthe flight goes on without the operator's port", true}, "operator_port");
  wanted_.operators.reset();
  return {};
}

// What it sees flows into the map as sightings do.
tl::expected<void, std::string> composition::make_eyes() {
  if (!wanted_.camera || !wanted_.flies)
    return {};
  const auto program = wanted_.eyes_program.empty() ? beside_this_program("godwit-eyes") : wanted_.eyes_program;
  auto made = io::eyes::helper::make({program, "session"});
  if (!made)
    return tl::make_unexpected(std::move(made.error()));
  eyes_ = *std::move(made);
  point_pictures_ = std::make_shared<point_pictures>(wanted_.pictures_folder);
  eyes_port_ = std::make_shared<movement_detector::eyes_process>(
      eyes_, [to = point_pictures_](const std::string& sighting_id, io::eyes::cutout what) {
        to->add(sighting_id, std::move(what));
      });
  auto tried = io::eyes::helper::make({program, "session"});
  if (!tried)
    return tl::make_unexpected(std::move(tried.error()));
  trial_eyes_ = *std::move(tried);
  io::eyes::begin how;
  how.uri = wanted_.camera->uri;
  camera_trial_ = std::make_shared<camera_trial>(
      camera_trial::helper_calls{[to = trial_eyes_, how](std::uint32_t run) { to->start(run, how); },
                                 [to = trial_eyes_](std::uint32_t upto) { to->end(upto); }});
  if (!feed_)
    feed_ = sighting_feed::without_file();
  return {};
}

tl::expected<void, std::string> composition::load_mission() {
  if (wanted_.mission_file.empty())
    return {};
  auto loaded = load_mission_file(wanted_.mission_file, wanted_.allow_partial, wanted_.allowed_commands);
  if (!loaded)
    return tl::make_unexpected(std::move(loaded.error()));
  const auto& mission = loaded->mission;
  wanted_.mission_id = mission.mission_id;
  wanted_.flight.mission_id = mission.mission_id;
  file_mission_ = mission;
  announce({"mission " + mission.mission_id + " from " + wanted_.mission_file + ": " +
                std::to_string(mission.items.size()) + " items, " + std::to_string(mission.geofences.size()) +
                " geofences",
            false},
           "mission_file");
  if (!loaded->losses.empty())
    announce({"taken without this:\n" + loaded->losses.message(), true}, "mission_file");
  return {};
}

} // namespace godwit::daemon
