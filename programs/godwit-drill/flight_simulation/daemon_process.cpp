#include "programs/godwit-drill/flight_simulation/daemon_process.hpp"

#include <algorithm>
#include <utility>

#include "actors/mapobjects_store/map_port.hpp"
#include "programs/godwit-drill/flight_simulation/flight_record.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/view_actors.hpp"
#include "runtime/assert.hpp"
#include "runtime/simulation/simulation.hpp"

namespace godwit::drill {

const std::int64_t daemon_process::wall_began_ns = runtime::simulated_time::start_ns;

struct daemon_process::parts {
  parts(process_surroundings& around, std::int64_t now_ns, std::uint64_t seed)
      : outside(around), eyes(std::make_shared<simulated_eyes>(around.eyes)),
        broker(std::make_shared<simulated_broker>(around.broker)), map(std::make_shared<stepped_map>(around.map_file)),
        world(around.journal, seed, around.record), facts([&around] { return around.free_disk_bytes; }, world.time()) {
    if (around.record != nullptr)
      around.record->begin_process(world.names(), world.time(), seed);
    world.pass_time_until(now_ns);
    world.set_wall_ahead(around.wall_ahead_ns);
    surround(seed);
    auto& actors = world.actors();
    base = daemon::add_base(actors, around.settings, meets);
    flight = daemon::add_flight(actors, around.settings, meets, base);
    if (around.settings.operators || around.settings.fleet)
      views_meet.stream = stream;
    if (around.settings.fleet)
      views_meet.fleet =
          daemon::fleet_surroundings{*around.settings.fleet, broker, seed, [this](const std::string& sentence, bool) {
                                       outside.say("fleet_link", sentence);
                                     }};
    views = daemon::add_views(actors, views_meet, base, flight);
    using executor::supervision::part;
    const bool flies = daemon::is_in_flight(around.journal.actors["executor"].kept);
    daemon::begin_supervision(actors, meets.process, flies ? part::flight : part::ground);
    open_ports();
  }

  void surround(std::uint64_t seed) {
    meets.vehicle = vehicle_wire;
    meets.map = map_port;
    if (outside.settings.service)
      meets.service = service_port;
    meets.ground = ground_wire;
    meets.sightings = feed;
    meets.eyes = eyes;
    if (const auto& folder = outside.settings.pictures_folder; !folder.empty()) {
      meets.point_pictures = std::make_shared<daemon::point_pictures>(folder);
      eyes->give_pictures(
          [to = meets.point_pictures](const std::string& id, io::eyes::cutout what) { to->add(id, std::move(what)); });
    }
    for (const auto& each : outside.seen)
      add(each);
    meets.seed = seed;
    meets.journal = &world.journal();
    meets.host = &facts;
    meets.process = outside.process;
    meets.say = [this](std::string_view part, const std::string& sentence, bool) { outside.say(part, sentence); };
    meets.on_phase_status = [this](const executor::phase_status& now) { outside.on_phase_status(now); };
  }

  // As composition::open() does it: what may fail before the actors, the links after them.
  void open_ports() {
    map_port->attach(std::shared_ptr<mapobjects_store::map_access>(map),
                     [this] { world.tell(base.store, mapobjects_store::wake{}); });
    if (meets.service)
      service_port->attach([this] { world.tell(base.client, mission_client::wake{}); });
    world.start();
    vehicle_wire->open([this] { world.tell(base.vehicle, vehicle_link::wake{}); });
    ground_wire->open([this] { world.tell(flight.ground, ground_port::wake{}); });
  }

  void add(const mapobjects_store::sighting& what) {
    const bool has_room = feed->add(what);
    GODWIT_ASSERT(has_room, "drill: not more is seen than the feed holds");
  }

  process_surroundings& outside;
  std::shared_ptr<daemon::sighting_feed> feed = daemon::sighting_feed::without_file();
  std::shared_ptr<simulated_wire> vehicle_wire = std::make_shared<simulated_wire>();
  std::shared_ptr<simulated_wire> ground_wire = std::make_shared<simulated_wire>();
  std::shared_ptr<simulated_service_port> service_port =
      std::make_shared<simulated_service_port>(outside.settings.pictures_folder);
  std::shared_ptr<mapobjects_store::map_port> map_port = std::make_shared<mapobjects_store::map_port>();
  std::shared_ptr<simulated_eyes> eyes;
  std::shared_ptr<simulated_broker> broker;
  std::shared_ptr<stepped_map> map;
  daemon::actor_surroundings meets;
  std::shared_ptr<telemetry_stream::hub> stream = std::make_shared<telemetry_stream::hub>();
  daemon::view_surroundings views_meet;
  runtime::simulation world;
  daemon::host_facts facts;
  daemon::base_actors base;
  daemon::flight_actors flight;
  daemon::view_actors views;
};

daemon_process::daemon_process(process_surroundings& outside, std::int64_t now_ns, std::uint64_t seed)
    : parts_(std::make_unique<parts>(outside, now_ns, seed)) {}

daemon_process::~daemon_process() = default;

std::int64_t daemon_process::next_timer_ns() const {
  return std::min(
      {parts_->world.next_timer_ns(), parts_->eyes->next_deadline_ns(), parts_->broker->next_deadline_ns()});
}

void daemon_process::pass_time_until(std::int64_t now_ns) {
  parts_->world.pass_time_until(now_ns);
  for (auto& each : parts_->eyes->on_time(now_ns))
    std::visit([this](auto& said) { parts_->world.tell(parts_->flight.eyes, std::move(said)); }, each);
  for (auto& each : parts_->broker->on_time(now_ns))
    std::visit([this](auto& said) { parts_->world.tell(parts_->views.fleet, std::move(said)); }, each);
}

bool daemon_process::step(std::uint64_t choice) {
  constexpr std::uint64_t map_share = 8; // of the steps one in so many is the map's, when it has something to do
  if (choice % map_share == 0 && parts_->map->step())
    return true;
  return parts_->world.step(choice / map_share) || parts_->map->step();
}

void daemon_process::run_until_idle() {
  do
    parts_->world.run_until_idle();
  while (parts_->map->step());
}

bool daemon_process::has_uncommitted() const { return parts_->world.journal().waiting() > 0; }

simulated_wire& daemon_process::vehicle_wire() { return *parts_->vehicle_wire; }

simulated_wire& daemon_process::ground_wire() { return *parts_->ground_wire; }

const std::shared_ptr<simulated_service_port>& daemon_process::service_port() const { return parts_->service_port; }

void daemon_process::say(const operators::command& what) { parts_->world.tell(parts_->flight.executor, what); }

daemon_process::answer daemon_process::command(const operator_bridge::operator_command& what) {
  constexpr std::chrono::seconds patience{4};
  return [asked = parts_->world.ask(parts_->flight.bridge, patience, what)] {
    return asked->answers == 0 ? std::nullopt : std::optional(asked->answer);
  };
}

void daemon_process::change_control(const operator_bridge::change_control& what) {
  constexpr std::chrono::seconds patience{4};
  (void)parts_->world.ask(parts_->flight.bridge, patience, what);
}

void daemon_process::see(const mapobjects_store::sighting& what) {
  parts_->outside.seen.push_back(what);
  parts_->add(what);
  parts_->world.tell(parts_->flight.feeder, sightings::woken{});
}

scan_controller::decide_answer daemon_process::decide(const scan_controller::decide_point& what) {
  const auto asked = parts_->world.ask(parts_->flight.scan, std::chrono::seconds(1), what);
  run_until_idle();
  return asked->answers == 1 ? asked->answer : scan_controller::decide_answer{false, asked->failure.what};
}

std::optional<scan_controller::points> daemon_process::points() {
  const auto asked = parts_->world.ask(parts_->flight.scan, std::chrono::seconds(1), scan_controller::get_points{});
  run_until_idle();
  return asked->answers == 1 ? std::optional(asked->answer) : std::nullopt;
}

std::optional<movement_detector::eyes_view> daemon_process::view_of_eyes() {
  const auto asked = parts_->world.ask(parts_->flight.eyes, std::chrono::seconds(1), movement_detector::get_eyes{});
  run_until_idle();
  return asked->answers == 1 ? std::optional(asked->answer) : std::nullopt;
}

simulated_eyes& daemon_process::eyes() { return *parts_->eyes; }

void daemon_process::crash_at(const std::string& actor, runtime::crash_point point) {
  parts_->world.forget_planned_crashes();
  parts_->world.crash_at(actor, point);
}

bool daemon_process::kill(const std::string& actor) { return parts_->world.kill(actor); }

void daemon_process::fail_journal(bool failing) { parts_->world.journal().fail_writes(failing); }

void daemon_process::fill_journal(bool full) { parts_->world.journal().refuse_writes(full); }

void daemon_process::hold_journal(bool held) { parts_->world.journal().hold(held); }

void daemon_process::sync_journal() {
  hold_journal(false);
  const auto before = parts_->outside.journal.commits;
  while (parts_->outside.journal.commits == before && parts_->world.journal().step()) {
  }
  hold_journal(true);
}

void daemon_process::hang(const std::string& actor) { parts_->world.hang(actor); }

void daemon_process::set_wall_ahead(std::int64_t ns) { parts_->world.set_wall_ahead(ns); }

runtime::health_colour daemon_process::health(const std::string& component) const {
  auto worst = runtime::health_colour::green;
  for (const auto& each : parts_->world.health().entries())
    if (each.component == component)
      worst = std::max(worst, each.colour);
  return worst;
}

std::shared_ptr<const health::report> daemon_process::report() {
  const auto before = parts_->views_meet.reports->newest();
  parts_->world.tell(parts_->views.health, health::make_report{});
  run_until_idle();
  const auto after = parts_->views_meet.reports->newest();
  return after == before ? nullptr : after;
}

std::shared_ptr<const health::report> daemon_process::newest_report() const {
  return parts_->views_meet.reports->newest();
}

telemetry_stream::hub& daemon_process::stream() { return *parts_->stream; }

health::report_port::seen_health daemon_process::newest_health() const {
  return parts_->views_meet.reports->newest_health();
}

std::optional<runtime::exit_request> daemon_process::wants_exit() const { return parts_->world.exit(); }

runtime::child_report daemon_process::look_at(const std::string& actor) {
  const auto asked =
      parts_->world.ask(parts_->world.actors().guardian(), std::chrono::seconds(1), runtime::get_children{});
  run_until_idle();
  const auto found = std::ranges::find(asked->answer.list, actor, &runtime::child_report::name);
  GODWIT_ASSERT(found != asked->answer.list.end(), "drill: the actor is one of the process's");
  return *found;
}

std::uint64_t daemon_process::crashes(const std::string& actor) const { return parts_->world.counters(actor).crashes; }

} // namespace godwit::drill
