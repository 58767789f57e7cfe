// What the parts are made with, and how they end. What is opened before and after: composition_open.cpp.
#include "programs/godwitd/composition.hpp"

#include <future>
#include <utility>

#include "actors/mission_client/actor.hpp"
#include "actors/telemetry_stream/core.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/host_facts.hpp"
#include "runtime/address/mail_view.hpp"

namespace godwit::daemon {

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

void composition::surround_actors() {
  facts_ = std::make_unique<host_facts>([file = wanted_.process.journal.path] { return free_bytes_beside(file); },
                                        host_->time(), [] { return is_without_name("/proc/self/exe"); });
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
  control::peers of_handler;
  of_handler.guardian = actors.guardian();
  of_handler.store = base_.store;
  of_handler.vehicle = base_.vehicle;
  if (service_)
    of_handler.client = base_.client;
  if (wanted_.flies)
    add_flight(of_handler);
  else
    add_ground_run(of_handler);
  surround_views();
  views_ = add_views(actors, views_outside_, base_, flight_);
  of_handler.health = views_.health;
  if (views_.fleet)
    of_handler.fleet = views_.fleet;
  of_handler.port = operators_.view();
  of_handler.rescue_journal = [this](control::peers::rescued then) {
    host_->journal().rescue([then = std::move(then)](tl::expected<std::string, runtime::journal_error> done) {
      then(std::move(done).map_error([](const runtime::journal_error& why) { return why.message(); }));
    });
  };
  if (wanted_.allow_crash)
    of_handler.crash = [&actors](const std::string& name) { return actors.kill_child(name); };
  request_handler_ =
      actors.add<control::request_handler>({.name = name(child_name::control_handler)},
                                           policy_of(child_name::control_handler), of_handler, control_answers_);
}

void composition::surround_views() {
  if (wanted_.operators || wanted_.fleet)
    views_outside_.stream = std::make_shared<telemetry_stream::hub>(outside_.seed);
  views_outside_.read_host = [this] { return read_host(); };
  views_outside_.pictured_points = pictured_points();
  if (!wanted_.fleet)
    return;
  broker_ = std::make_shared<fleet_link::mqtt_port>(*wanted_.fleet);
  views_outside_.fleet =
      fleet_surroundings{*wanted_.fleet, broker_, outside_.seed, [this](const std::string& sentence, bool is_warning) {
                           announce({sentence, is_warning}, "fleet_link");
                         }};
}

void composition::add_ground_run(control::peers& of_handler) {
  const auto of_run = std::make_shared<ground_run::peers>();
  run_ = host_->actors().add<ground_run::actor>(
      {.name = name(child_name::ground_run)}, policy_of(child_name::ground_run), settings_of_run(),
      std::shared_ptr<const ground_run::peers>(of_run), feed_, world_of_run());
  of_run->store = base_.store;
  of_run->vehicle = base_.vehicle;
  if (service_)
    of_run->client = base_.client;
  base_.of_client->listener = run_;
  of_handler.run = run_;
  base_.of_vehicle->add(run_);
}

void composition::add_flight(control::peers& of_handler) {
  flight_ = daemon::add_flight(host_->actors(), wanted_, outside_, base_);
  of_handler.flight = flight_.executor;
  of_handler.missions = flight_.executor;
  of_handler.traffic = flight_.executor;
  of_handler.bridge = flight_.bridge;
  of_handler.read_audit = audit_of_journal();
  if (wanted_.operators)
    operators_.add_handlers(host_->actors(), wanted_, base_, flight_, pictured_points(), audit_of_journal());
  if (wanted_.ground)
    of_handler.ground = control::ground_handle(flight_.ground);
  of_handler.failsafe = base_.failsafe;
  of_handler.failsafe_status = base_.failsafe;
  of_handler.sightings = flight_.feeder;
  of_handler.points = flight_.scan;
  if (flight_.eyes)
    of_handler.eyes = flight_.eyes;
}

audit_source composition::audit_of_journal() {
  if (!audit_)
    audit_ = std::make_unique<audit_reader>(wanted_.process.journal.path);
  return [reader = audit_.get()](const operator_bridge::audit_query& wanted, auto then) {
    reader->read(wanted, std::move(then));
  };
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

std::function<std::vector<std::uint64_t>()> composition::pictured_points() const {
  if (!point_pictures_)
    return {};
  return [pictures = point_pictures_] { return pictures->points(); };
}

health::host_figures composition::read_host() {
  health::host_figures result;
  for (auto& [actor, waiting, c] : runtime::look_at_mail(host_->actors()))
    result.mail.push_back({std::move(actor), waiting, c.accepted, c.handled, c.crashes, c.requeued, c.dead_lettered,
                           c.repeated, c.lost, c.refused, c.dropped, c.not_accepted});
  const auto journal = host_->look_at_journal();
  result.journal = {journal.failing, journal.reason,  journal.commits, journal.writes, journal.events,
                    journal.retries, journal.refused, journal.queued,  journal.fill,   journal.run};
  const auto trace = host_->traced();
  result.trace = {trace.recorded, trace.dropped, trace.oversize, trace.written, trace.unwritten};
  result.process = look_at_process(began_ms_);
  result.process.free_disk_bytes = facts_->free_bytes();
  return result;
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
  if (broker_)
    broker_->detach();
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
