// What is live, for fleet_link: one subscriber of the hub, of the topics that go to a broker. One that was too slow is
// made anew, and hears first how everything stands. Thread: one.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "actors/fleet_link/live_texts.hpp"
#include "actors/telemetry_stream/hub.hpp"

namespace godwit::daemon {

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
