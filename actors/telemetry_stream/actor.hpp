// The stream of telemetry as an actor: hears the vehicle, the executor and the health of all, and publishes each thing
// once, in its hub.
//
//   vehicle_link, executor, health, scan_controller ──> core ──> hub ──> subscribers
//
// The map does not tell its changes: it is asked each 2 s while the hub has a subscriber. So is scan_controller, and
// also whenever it tells that a point is shown or closed: what it answers is the whole. Nothing is durable; the hub
// outlives the incarnations, and with it the subscribers and the newest of each topic. Policy `lose`: what was said to
// an incarnation that crashed is old. Errors: none. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "actors/telemetry_stream/core.hpp"
#include "actors/telemetry_stream/hub.hpp"
#include "messages/telemetry_stream/handle.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::telemetry_stream {

// Filled in while the process is composed, before the actors start. What is empty is not asked.
struct peers {
  runtime::mailbox<runtime::asks<mapobjects_store::get_map, mapobjects_store::map_status>> map;
  runtime::mailbox<runtime::asks<executor::get_flight, executor::flight_status>> flight;
  runtime::mailbox<runtime::asks<executor::get_missions, executor::known_missions>> missions;
  runtime::mailbox<runtime::asks<scan_controller::get_points, scan_controller::points>> points;
  std::function<std::vector<std::uint64_t>()> pictured; // numbers of points that the camera has shown; does not block
};

// Whether anybody listens: an input that comes by no mailbox.
struct audience {
  bool is_there = false;
  GODWIT_FIELDS(audience, "telemetry_stream.audience", is_there);
};

// Points that the camera has shown; the same.
struct pictured_points {
  std::vector<std::uint64_t> numbers;
  GODWIT_FIELDS(pictured_points, "telemetry_stream.pictured_points", numbers);
};

class actor final : public runtime::actor_base<own_handle> {
public:
  static constexpr std::chrono::seconds beat_period{1};
  static constexpr std::chrono::seconds answer_timeout{2};
  static constexpr std::uint64_t beats_a_question = 2;

  actor(runtime::spawn_context context, std::shared_ptr<const peers> others, std::shared_ptr<hub> to);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void on_deadline() override;

private:
  template <class M>
  auto shows();
  void publish(publications all);
  void ask_round();
  void ask_points();

  std::shared_ptr<const peers> others_;
  std::shared_ptr<hub> hub_;
  core core_;
  std::uint64_t beats_ = 0;
  std::optional<audience> seen_;            // as recorded last
  std::optional<pictured_points> pictured_; // the same
};

} // namespace godwit::telemetry_stream
