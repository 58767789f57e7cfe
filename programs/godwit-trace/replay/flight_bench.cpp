#include "programs/godwit-trace/replay/flight_bench.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "actors/ground_port/link_port.hpp"
#include "actors/vehicle_link/link_port.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/view_actors.hpp"

namespace godwit::trace_tool {

namespace {

struct refusal {
  std::string_view actor;
  std::string_view why;
};

constexpr std::array refusals{
    refusal{"mapobjects_store", "its state is the file of the map, and the trace does not have it"},
    refusal{"control_handler", "what it asks of the process reaches it beside its mailbox"},
    refusal{"sightings", "what it reads reaches it beside its mailbox"},
    refusal{"ground_run", "what it reads reaches it beside its mailbox"},
    refusal{"guardian", "its messages are not recorded"},
};

constexpr std::string_view replayed_actors =
    "executor, failsafe, vehicle_link, ground_port, mission_client, operator_bridge, scan_controller, "
    "movement_detector, telemetry_stream, health, fleet_link, landing_watch";

// Nothing of what an actor does reaches these; what they gave it is in the record.
class no_service final : public mission_client::service_port {
public:
  std::uint64_t send(mission_client::service_call) override { return next_number_++; }
  void cancel(std::uint64_t) override {}
  void cancel_all() override {}

private:
  std::uint64_t next_number_ = 1;
};

class no_eyes final : public movement_detector::eyes_port {
public:
  void start(std::uint32_t, const io::eyes::begin&) override {}
  void end(std::uint32_t) override {}
  void tell(const io::eyes::pose&) override {}
  void keep_picture(std::uint32_t, std::int64_t, const std::string&) override {}
};

class no_broker final : public fleet_link::broker_port {
public:
  void open(std::uint64_t, const fleet_link::publication&) override {}
  void close(std::uint64_t) override {}
  void publish(std::uint64_t, const fleet_link::publication&) override {}
};

// A signed line can not be spoken without its key.
bool is_signed(const std::string& actor, const daemon::daemon_settings& settings) {
  return (actor == "vehicle_link" && !settings.signing_key_file.empty()) ||
         (actor == "ground_port" && !settings.ground_key_file.empty());
}

std::string why_not(const std::string& actor, const daemon::daemon_settings& settings, runtime::actor_bench& bench) {
  if (is_signed(actor, settings))
    return actor + " can not be replayed: its line is signed, and the trace does not have the key";
  if (const auto found = std::ranges::find(refusals, actor, &refusal::actor); found != refusals.end())
    return actor + " can not be replayed: " + std::string(found->why);
  if (bench.choose(actor))
    return {};
  return "there was no actor " + actor + " in that godwitd; these can be replayed: " + std::string(replayed_actors);
}

} // namespace

struct flight_bench::parts {
  parts(const daemon::daemon_settings& given, const recorded_process& of)
      : settings(given), bench(of.run), facts([] { return std::nullopt; }, bench.time()) {
    outside.vehicle = std::make_shared<vehicle_link::link_port>();
    outside.map = std::make_shared<mapobjects_store::map_port>();
    if (settings.service)
      outside.service = std::make_shared<no_service>();
    if (settings.ground)
      outside.ground = std::make_shared<ground_port::link_port>();
    if (settings.camera)
      outside.eyes = std::make_shared<no_eyes>();
    outside.seed = of.seed;
    outside.journal = &bench.disk();
    outside.host = &facts;
    outside.say = [](std::string_view, const std::string&, bool) {};
    outside.on_phase_status = [](const executor::phase_status&) {};
    const auto base = daemon::add_base(bench.actors(), settings, outside);
    const auto flight = daemon::add_flight(bench.actors(), settings, outside, base);
    if (settings.operators || settings.fleet) // the executor told whoever showed it
      views.stream = std::make_shared<telemetry_stream::hub>();
    if (settings.fleet)
      views.fleet = daemon::fleet_surroundings{*settings.fleet, std::make_shared<no_broker>(), of.seed,
                                               [](const std::string&, bool) {}};
    (void)daemon::add_views(bench.actors(), views, base, flight);
  }

  daemon::daemon_settings settings;
  runtime::actor_bench bench;
  daemon::host_facts facts;
  daemon::actor_surroundings outside; // its actors call it
  daemon::view_surroundings views;
};

flight_bench::flight_bench(const daemon::daemon_settings& settings, const recorded_process& of)
    : parts_(std::make_unique<parts>(settings, of)) {}

flight_bench::~flight_bench() = default;

tl::expected<std::unique_ptr<flight_bench>, std::string>
flight_bench::make(const std::string& actor, const daemon::daemon_settings& settings, const recorded_process& of) {
  if (!settings.flies)
    return tl::unexpected(std::string("a run on the ground has no actor that can be replayed"));
  std::unique_ptr<flight_bench> result(new flight_bench(settings, of));
  if (auto why = why_not(actor, settings, result->bench()); !why.empty())
    return tl::unexpected(std::move(why));
  return result;
}

runtime::actor_bench& flight_bench::bench() { return parts_->bench; }

} // namespace godwit::trace_tool
