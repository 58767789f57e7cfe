#include "programs/godwitd/composition.hpp"

#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include <sys/eventfd.h>

#include "actors/mapobjects_store/actor.hpp"
#include "actors/vehicle_link/actor.hpp"
#include "io/http/secret_file.hpp"
#include "io/mavlink/signing/key_file.hpp"
#include "programs/godwitd/console.hpp"
#include "programs/godwitd/convert_command.hpp"

namespace godwit::daemon {
namespace {

using checked = tl::expected<void, std::string>;

// For the keys of deliveries, which nobody else may ever make.
std::uint64_t fresh_seed() {
  std::random_device source;
  return (std::uint64_t{source()} << 32U) | source();
}

constexpr runtime::child_policy essential{.essential = true, .restart = {}};
constexpr runtime::child_policy replaceable{};

} // namespace

tl::expected<std::unique_ptr<composition>, std::string> composition::make(daemon_settings wanted, program_log& log) {
  std::unique_ptr<composition> result(new composition(std::move(wanted), log));
  if (auto opened = result->open_files(); !opened)
    return tl::make_unexpected(std::move(opened.error()));
  result->add_actors();
  return result;
}

checked composition::open_files() {
  if (auto loaded = load_mission(); !loaded)
    return loaded;
  if (!wanted_.signing_key_file.empty()) {
    auto key = io::mavlink::load_key_file(wanted_.signing_key_file);
    if (!key)
      return tl::make_unexpected(key.error().message());
    signing_.key = std::make_shared<io::mavlink::secret_key>(*std::move(key));
  }
  if (wanted_.service) {
    if (!wanted_.service->token_file.empty())
      if (const auto token = io::http::load_token(wanted_.service->token_file); !token)
        return tl::make_unexpected(token.error().message());
    auto service = mission_client::http_service::open(*wanted_.service);
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
  io::link::descriptor readable(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!readable.is_open())
    return tl::make_unexpected(std::string("no descriptor is left: ") + std::strerror(errno));
  control_answers_ = std::make_shared<control::answer_box>(std::move(readable));
  wanted_.process.seed = fresh_seed();
  auto host = runtime::process::open(wanted_.process);
  if (!host)
    return tl::make_unexpected(std::move(host.error()));
  host_ = *std::move(host);
  return {};
}

checked composition::load_mission() {
  if (wanted_.mission_file.empty())
    return {};
  auto loaded = load_mission_file(wanted_.mission_file, wanted_.allow_partial);
  if (!loaded)
    return tl::make_unexpected(std::move(loaded.error()));
  const auto& mission = loaded->mission;
  wanted_.mission_id = mission.mission_id;
  announce({"mission " + mission.mission_id + " from " + wanted_.mission_file + ": " +
                std::to_string(mission.items.size()) + " items, " + std::to_string(mission.geofences.size()) +
                " geofences",
            false},
           "mission_file");
  if (!loaded->losses.empty())
    announce({"taken without this:\n" + loaded->losses.message(), true}, "mission_file");
  return {};
}

void composition::add_actors() {
  auto& actors = host_->actors();
  const auto ears = std::make_shared<vehicle_link::listeners>();
  const auto of_client = std::make_shared<mission_client::neighbours>();
  const auto of_run = std::make_shared<ground_run::neighbours>();
  vehicle_link::settings link;
  link.watch.system = wanted_.vehicle_system;

  vehicle_ = actors.add<vehicle_link::actor>({.name = "vehicle_link"}, essential, link, signing_,
                                             std::static_pointer_cast<io::link::wire>(vehicle_port_),
                                             std::shared_ptr<const vehicle_link::listeners>(ears));
  store_ = actors.add<mapobjects_store::actor>({.name = "mapobjects_store"}, replaceable, map_port_);
  if (service_)
    client_ =
        actors.add<mission_client::actor>({.name = "mission_client"}, replaceable, wanted_.client,
                                          std::static_pointer_cast<mission_client::service_port>(service_),
                                          std::shared_ptr<const mission_client::neighbours>(of_client), fresh_seed());
  run_ = actors.add<ground_run::actor>({.name = "ground_run"}, essential, settings_of_run(),
                                       std::shared_ptr<const ground_run::neighbours>(of_run), feed_, world_of_run());
  control::neighbours of_desk;
  of_desk.store = store_;
  of_desk.vehicle = vehicle_;
  of_desk.run = run_;
  if (service_) {
    of_desk.client = client_;
    of_run->client = client_;
  }
  desk_ = actors.add<control::desk>({.name = "control_desk"}, replaceable, of_desk, control_answers_);

  of_client->listener = run_;
  of_client->map = store_;
  of_run->store = store_;
  of_run->vehicle = vehicle_;
  ears->add(run_);
}

checked composition::open() {
  // What may fail comes first; mail waits at the addresses until the actors are there.
  if (auto opened = open_map(); !opened)
    return opened;
  if (auto opened = open_control(); !opened)
    return opened;
  if (service_) // before the first call can be answered
    service_->attach(host_->actors().make_gateway("missions_service"), client_);
  host_->actors().start();
  open_vehicle();
  open_feed();
  return {};
}

checked composition::open_map() {
  if (auto opened = map_port_->open(wanted_.map, host_->actors().make_gateway("map_writer"), store_); !opened)
    return tl::make_unexpected(opened.error().message());
  return {};
}

checked composition::open_control() {
  const auto way_in = std::make_shared<runtime::gateway>(host_->actors().make_gateway("control_socket"));
  auto opened = control::server::open(
      wanted_.control_path, control_answers_,
      [way_in, desk = desk_](control::control_request asked) { way_in->tell(desk, std::move(asked)); });
  if (!opened)
    return tl::make_unexpected(std::move(opened.error()));
  control_ = *std::move(opened);
  return {};
}

// A vehicle that can not be reached is no reason to keep what is owed to the service.
void composition::open_vehicle() {
  if (const auto opened =
          vehicle_port_->open(wanted_.vehicle, {}, host_->actors().make_gateway("vehicle_port"), vehicle_);
      !opened)
    announce({"the link to the vehicle can not be opened: " + opened.error() +
                  "\ngodwitd goes on without a vehicle; mend it and start godwitd again",
              true},
             "vehicle_link");
}

void composition::open_feed() {
  if (!feed_)
    return;
  const auto way_in = std::make_shared<runtime::gateway>(host_->actors().make_gateway("sighting_feed"));
  feed_->start([way_in, run = run_] { way_in->tell(run, ground_run::woken{}); },
               [this](const std::string& sentence) {
                 announce({sentence, true}, "sighting_feed");
               });
}

ground_run::settings composition::settings_of_run() const {
  return {wanted_.mission_id, service_ != nullptr, feed_ != nullptr, wanted_.once};
}

ground_run::run_world composition::world_of_run() {
  return {[this](const ground_run::announce& said) { announce(said); },
          [this](const ground_run::finish& how) {
            end_.set({how.well, how.why});
            host_->actors().request_exit({runtime::exit_cause::requested, "the run has ended"});
          }};
}

void composition::announce(const ground_run::announce& said, std::string_view part) {
  log_.say(said.is_warning ? log_level::warning : log_level::info, part, said.sentence);
}

int composition::close(runtime::exit_code code) {
  control_.reset();
  if (feed_)
    feed_->stop();
  vehicle_port_->close();
  if (service_)
    service_->close();
  map_port_->close();
  return host_->finish(static_cast<int>(code));
}

} // namespace godwit::daemon
