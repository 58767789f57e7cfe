// The actors that only show what there is: health, the stream of telemetry, and the way to a broker. The flight does
// not depend on them.
//
//   all actors ──answers, news──> health ── report_port ──> the operator's port
//   vehicle_link, executor, health, scan_controller ──> telemetry_stream ── hub ──> subscribers
//   the same, failsafe, hub ──> fleet_link ── broker_port ══ broker
//
// Made after all others, whom they watch. Thread: one owner, before the actors start. OUTSIDE outlives the actors, and
// its functions may be called by any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/fleet_link/broker_port.hpp"
#include "actors/fleet_link/live_texts.hpp"
#include "actors/fleet_link/settings.hpp"
#include "actors/health/report_port.hpp"
#include "actors/telemetry_stream/hub.hpp"
#include "messages/fleet_link/handle.hpp"
#include "messages/health/handle.hpp"
#include "messages/telemetry_stream/handle.hpp"
#include "programs/godwitd/flight_actors.hpp"

namespace godwit::daemon {

struct fleet_surroundings {
  fleet_link::settings how;
  std::shared_ptr<fleet_link::broker_port> port;
  std::uint64_t process = 0; // another one for each
  std::function<void(const std::string& sentence, bool is_warning)> say;
};

struct view_surroundings {
  std::shared_ptr<health::report_port> reports = std::make_shared<health::report_port>();
  std::function<health::host_figures()> read_host;             // empty: there are none
  std::shared_ptr<telemetry_stream::hub> stream;               // none: nobody can subscribe, and there is no stream
  std::function<std::vector<std::uint64_t>()> pictured_points; // of interest, that the camera has shown; empty: none
  std::optional<fleet_surroundings> fleet;                     // with a stream; none: no broker is told anything
};

struct view_actors {
  health::own_handle health;
  telemetry_stream::own_handle stream;
  fleet_link::own_handle fleet; // none without a broker
};

[[nodiscard]] view_actors add_views(runtime::system& actors, const view_surroundings& outside, const base_actors& base,
                                    const flight_actors& flight);

// What is live, for fleet_link: one subscriber of the hub, of the topics that go to a broker. One that was too slow is
// made anew, and hears first how everything stands. Thread: one.
class hub_reader {
public:
  // For fleet_link::peers.
  [[nodiscard]] static std::function<fleet_link::text_ptr()> open(std::shared_ptr<telemetry_stream::hub> from) {
    return [reader = std::make_shared<hub_reader>(std::move(from))] { return reader->take(); };
  }

  explicit hub_reader(std::shared_ptr<telemetry_stream::hub> from) : from_(std::move(from)) {}

  // Null: there is none now.
  [[nodiscard]] fleet_link::text_ptr take() {
    if (!subscriber_ || subscriber_->has_ended()) {
      std::vector<telemetry_stream::wanted_topic> wanted;
      for (const auto& each : fleet_link::live_rows)
        wanted.push_back({each.what, 0});
      subscriber_ = from_->subscribe(wanted, [] {}).value_or(nullptr);
    }
    return subscriber_ ? subscriber_->take() : nullptr;
  }

private:
  std::shared_ptr<telemetry_stream::hub> from_;
  std::shared_ptr<telemetry_stream::subscriber> subscriber_; // none: the hub has no room
};

} // namespace godwit::daemon
