#include "programs/godwitd/composition.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <future>
#include <iterator>
#include <mutex>
#include <random>
#include <system_error>
#include <utility>

#include <sys/eventfd.h>

#include "actors/executor/state.hpp"
#include "actors/mission_client/actor.hpp"
#include "actors/telemetry_stream/core.hpp"
#include "io/http/secret_file.hpp"
#include "io/mavlink/signing/key_file.hpp"
#include "programs/godwitd/child_policies.hpp"
#include "programs/godwitd/console.hpp"
#include "programs/godwitd/convert_command.hpp"
#include "programs/godwitd/flight_state.hpp"
#include "programs/godwitd/open_line.hpp"
#include "programs/godwitd/option_table.hpp"
#include "programs/godwitd/process_figures.hpp"
#include "runtime/mail_view.hpp"

namespace godwit::daemon {
namespace {

using checked = tl::expected<void, std::string>;

// For the keys of deliveries, which nobody else may ever make.
std::uint64_t fresh_seed() {
  std::random_device source;
  return (std::uint64_t{source()} << 32U) | source();
}

// Without a file the link is not signed.
checked load_key(const std::string& file, io::mavlink::signing_settings& into) {
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

composition::composition(daemon_settings wanted, program_log& log) : wanted_(std::move(wanted)), log_(log) {}

tl::expected<std::unique_ptr<composition>, std::string> composition::make(daemon_settings wanted, program_log& log) {
  std::unique_ptr<composition> result(new composition(std::move(wanted), log));
  if (auto opened = result->open_files(); !opened)
    return tl::make_unexpected(std::move(opened.error()));
  if (auto checked = result->check_operators(); !checked)
    return tl::make_unexpected(std::move(checked.error()));
  result->surround_actors();
  result->add_actors();
  return result;
}

checked composition::open_files() {
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
checked composition::check_operators() {
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
checked composition::make_eyes() {
  if (!wanted_.camera || !wanted_.flies)
    return {};
  const auto program = wanted_.eyes_program.empty() ? beside_this_program("godwit-eyes") : wanted_.eyes_program;
  auto made = io::eyes::helper::make({program, "session"});
  if (!made)
    return tl::make_unexpected(std::move(made.error()));
  eyes_ = *std::move(made);
  point_pictures_ = std::make_shared<point_pictures>();
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

checked composition::load_mission() {
  if (wanted_.mission_file.empty())
    return {};
  auto loaded = load_mission_file(wanted_.mission_file, wanted_.allow_partial);
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

void composition::surround_actors() {
  facts_ = std::make_unique<host_facts>([file = wanted_.process.journal.path] { return free_bytes_beside(file); },
                                        host_->time());
  outside_.vehicle = vehicle_port_;
  outside_.map = map_port_;
  outside_.service = service_;
  if (wanted_.ground)
    outside_.ground = ground_line_;
  outside_.sightings = feed_;
  outside_.eyes = eyes_port_;
  outside_.point_pictures = point_pictures_;
  outside_.camera = camera_trial_;
  outside_.journal = &host_->journal();
  outside_.host = facts_.get();
  outside_.say = [this](std::string_view part, const std::string& sentence, bool is_warning) {
    announce({sentence, is_warning}, part);
  };
  outside_.on_phase_status = [](const executor::phase_status&) {}; // nobody else wants to know
}

void composition::add_actors() {
  auto& actors = host_->actors();
  base_ = add_base(actors, wanted_, outside_);
  control::peers of_desk;
  of_desk.guardian = actors.guardian();
  of_desk.store = base_.store;
  of_desk.vehicle = base_.vehicle;
  if (service_)
    of_desk.client = base_.client;
  if (wanted_.flies)
    add_flight(of_desk);
  else
    add_ground_run(of_desk);
  surround_views();
  views_ = add_views(actors, views_outside_, base_, flight_);
  of_desk.health = views_.health;
  if (views_.fleet)
    of_desk.fleet = views_.fleet;
  of_desk.port = operators_.view();
  of_desk.rescue_journal = [this](control::peers::rescued then) {
    host_->journal().rescue([then = std::move(then)](tl::expected<std::string, runtime::journal_error> done) {
      then(std::move(done).map_error([](const runtime::journal_error& why) { return why.message(); }));
    });
  };
  if (wanted_.allow_crash)
    of_desk.crash = [&actors](const std::string& name) { return actors.kill_child(name); };
  request_handler_ =
      actors.add<control::request_handler>({.name = "control_desk"}, replaceable, of_desk, control_answers_);
}

void composition::surround_views() {
  if (wanted_.operators || wanted_.fleet)
    views_outside_.stream = std::make_shared<telemetry_stream::hub>(outside_.seed);
  views_outside_.read_host = [this] { return read_host(); };
  views_outside_.pictured_points = pictured_points();
  if (!wanted_.fleet)
    return;
  broker_ = make_broker_access(*wanted_.fleet);
  views_outside_.fleet = fleet_surroundings{*wanted_.fleet, broker_.port, outside_.seed,
                                            [this](const std::string& sentence, bool is_warning) {
                                              announce({sentence, is_warning}, "fleet_link");
                                            }};
}

void composition::add_ground_run(control::peers& of_desk) {
  const auto of_run = std::make_shared<ground_run::peers>();
  run_ =
      host_->actors().add<ground_run::actor>({.name = "ground_run"}, essential, settings_of_run(),
                                             std::shared_ptr<const ground_run::peers>(of_run), feed_, world_of_run());
  of_run->store = base_.store;
  of_run->vehicle = base_.vehicle;
  if (service_)
    of_run->client = base_.client;
  base_.of_client->listener = run_;
  of_desk.run = run_;
  base_.of_vehicle->add(run_);
}

void composition::add_flight(control::peers& of_desk) {
  flight_ = daemon::add_flight(host_->actors(), wanted_, outside_, base_);
  of_desk.flight = flight_.executor;
  of_desk.missions = flight_.executor;
  of_desk.bridge = flight_.bridge;
  if (wanted_.operators)
    operators_.add_desks(host_->actors(), wanted_, base_, flight_, pictured_points());
  if (wanted_.ground)
    of_desk.ground = control::ground_handle(flight_.ground);
  of_desk.failsafe = base_.failsafe;
  of_desk.failsafe_status = base_.failsafe;
  of_desk.sightings = flight_.feeder;
  of_desk.points = flight_.scan;
  if (flight_.eyes)
    of_desk.eyes = flight_.eyes;
}

bool composition::is_in_flight() {
  if (!was_in_flight_)
    was_in_flight_ = wanted_.flies && reads_in_flight();
  return *was_in_flight_;
}

bool composition::reads_in_flight() {
  std::promise<tl::expected<runtime::recovered, runtime::journal_error>> read;
  host_->journal().recover("executor", 0, [&read](auto result) { read.set_value(std::move(result)); });
  const auto result = read.get_future().get();
  return result && daemon::is_in_flight(*result);
}

checked composition::open() {
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
  if (broker_.attach)
    broker_.attach(host_->actors().make_gateway("broker_port"), views_.fleet);
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
    operators_.open(*host_, *wanted_.operators, views_outside_, views_, {eyes_, point_pictures_, keeper_.get()},
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

checked composition::open_map() {
  if (auto opened = map_port_->open(wanted_.map, host_->actors().make_gateway("map_writer"), base_.store); !opened)
    return tl::make_unexpected(opened.error().message());
  return {};
}

checked composition::open_control() {
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

std::function<std::vector<std::uint64_t>()> composition::pictured_points() const {
  if (!point_pictures_)
    return {};
  return [pictures = point_pictures_] { return pictures->points(); };
}

health::host_figures composition::read_host() const {
  health::host_figures result;
  for (auto& [actor, waiting, c] : runtime::look_at_mail(host_->actors()))
    result.mail.push_back({std::move(actor), waiting, c.accepted, c.handled, c.crashes, c.requeued, c.dead_lettered,
                           c.repeated, c.lost, c.refused, c.dropped, c.not_accepted});
  const auto journal = host_->journal().status();
  result.journal = {journal.failing, journal.reason,  journal.commits, journal.writes, journal.events,
                    journal.retries, journal.refused, journal.queued,  journal.fill,   journal.run};
  const auto trace = host_->traced();
  result.trace = {trace.recorded, trace.dropped, trace.oversize, trace.written, trace.unwritten};
  result.process = look_at_process(began_ms_);
  result.process.free_disk_bytes = facts_->free_bytes();
  return result;
}

// The mission of a file is told to whoever flies it, as the service's would be.
void composition::hand_over_mission() {
  if (!wanted_.flies || !file_mission_)
    return;
  mission_client::mission_loaded loaded;
  loaded.document = *file_mission_;
  host_->actors().make_gateway("mission_file").tell(flight_.executor, loaded);
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
  if (!views_outside_.stream)
    return;
  auto line = views_outside_.stream->publish(
      telemetry_stream::topic::log,
      telemetry_stream::json_of(telemetry_stream::log_update{said.is_warning, std::string(part), said.sentence}),
      host_->time().wall_ns() / 1'000'000, host_->time().monotonic_ns());
  if (wanted_.operators)
    operators_.note(std::move(line));
}

int composition::close(runtime::exit_code code) {
  keeper_.reset();
  operators_.end_answers();
  operators_.close();
  control_.reset();
  if (feed_)
    feed_->stop();
  if (eyes_)
    eyes_->close();
  if (trial_eyes_)
    trial_eyes_->close();
  if (broker_.detach)
    broker_.detach();
  vehicle_port_->close();
  ground_line_->close();
  if (link_log_)
    link_log_->close();
  if (service_)
    service_->close();
  map_port_->close();
  return host_->finish(static_cast<int>(code));
}

} // namespace godwit::daemon
