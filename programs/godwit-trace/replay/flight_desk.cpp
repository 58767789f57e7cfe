#include "programs/godwit-trace/replay/flight_desk.hpp"

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
    refusal{"vehicle_link", "the bytes of its link reach it beside its mailbox, and the trace does not have them"},
    refusal{"ground_port", "the bytes of its line reach it beside its mailbox, and the trace does not have them"},
    refusal{"mission_client",
            "the answers of the service reach it beside its mailbox, and the trace does not have them"},
    refusal{"mapobjects_store", "its state is the file of the map, and the trace does not have it"},
    refusal{"landing_watch", "it keeps no state, and where its incarnations begin is not in the trace"},
    refusal{"control_desk", "what it asks of the process reaches it beside its mailbox"},
    refusal{"sightings", "what it reads reaches it beside its mailbox"},
    refusal{"ground_run", "what it reads reaches it beside its mailbox"},
    refusal{"health", "what it reads of the process reaches it beside its mailbox"},
    refusal{"telemetry_stream", "it keeps no state, and where its incarnations begin is not in the trace"},
    refusal{"guardian", "its messages are not recorded"},
};

// The actors that have a service are not replayed; the others only have to be told apart by it.
class no_service final : public mission_client::service_port {
public:
  std::uint64_t send(mission_client::service_call) override { return 0; }
  void cancel(std::uint64_t) override {}
  void cancel_all() override {}
};

std::string why_not(const std::string& actor, runtime::desk& bench) {
  if (const auto found = std::ranges::find(refusals, actor, &refusal::actor); found != refusals.end())
    return actor + " can not be replayed: " + std::string(found->why);
  if (bench.choose(actor))
    return {};
  return "there is no actor " + actor + " in godwitd; these can be replayed: executor, failsafe";
}

} // namespace

struct flight_desk::parts {
  parts(const daemon::daemon_settings& given, std::uint64_t run)
      : settings(given), bench(run), facts([] { return std::nullopt; }, bench.time()) {
    outside.vehicle = std::make_shared<vehicle_link::link_port>();
    outside.map = std::make_shared<mapobjects_store::map_port>();
    if (settings.service)
      outside.service = std::make_shared<no_service>();
    if (settings.ground)
      outside.ground = std::make_shared<ground_port::link_port>();
    outside.journal = &bench.disk();
    outside.host = &facts;
    outside.say = [](std::string_view, const std::string&, bool) {};
    outside.on_phase_status = [](const executor::phase_status&) {};
    const auto base = daemon::add_base(bench.actors(), settings, outside);
    const auto flight = daemon::add_flight(bench.actors(), settings, outside, base);
    if (settings.operators) // the executor told whoever showed it
      views.stream = std::make_shared<telemetry_stream::hub>();
    (void)daemon::add_views(bench.actors(), views, base, flight);
  }

  daemon::daemon_settings settings;
  runtime::desk bench;
  daemon::host_facts facts;
  daemon::actor_surroundings outside; // its actors call it
  daemon::view_surroundings views;
};

flight_desk::flight_desk(const daemon::daemon_settings& settings, std::uint64_t run)
    : parts_(std::make_unique<parts>(settings, run)) {}

flight_desk::~flight_desk() = default;

tl::expected<std::unique_ptr<flight_desk>, std::string>
flight_desk::make(const std::string& actor, const daemon::daemon_settings& settings, std::uint64_t run) {
  if (!settings.flies)
    return tl::unexpected(std::string("a run on the ground has no actor that can be replayed"));
  std::unique_ptr<flight_desk> result(new flight_desk(settings, run));
  if (auto why = why_not(actor, result->bench()); !why.empty())
    return tl::unexpected(std::move(why));
  return result;
}

runtime::desk& flight_desk::bench() { return parts_->bench; }

} // namespace godwit::trace_tool
