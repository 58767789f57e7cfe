// The eyes as an actor: starts the helper process, watches and feeds it, and hands on what it finds.
//
//   vehicle_link ──attitude, position──> actor ──pose──> eyes_port ══ godwit-eyes ══> status, candidates ──> actor
//   executor ──survey_progress──> actor ──sighting──> sightings ──> mapobjects_store, scan_controller
//                                   └──view──> scan_controller: a pass that nobody saw is none
//
// The decisions are in core.hpp. Nothing is durable: a new incarnation starts the helper anew. It sends the vehicle
// nothing. Policy `lose`. Errors: health, and a sentence for people. Thread: as actor_base.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "actors/movement_detector/core.hpp"
#include "actors/movement_detector/eyes_port.hpp"
#include "messages/movement_detector/handle.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::movement_detector {

// Filled in while the process is composed, before the actors start.
struct peers {
  sightings_handle sightings;
  scan_controller::view_handle scan;
  // For people. May be called by any thread and does not block.
  std::function<void(const std::string& sentence, bool is_warning)> say;
};

class actor final : public runtime::actor_base<own_handle> {
public:
  actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
        std::shared_ptr<eyes_port> port, std::uint64_t seed);
  ~actor() override; // ends the helper

protected:
  behavior_type handlers() override;
  void started() override;
  void on_deadline() override;

private:
  [[nodiscard]] instant now() {
    const auto at = handler_time();
    return {at.monotonic_ns, at.wall_ns};
  }
  void note_calls(const effects& all);
  void execute(effects all);

  std::shared_ptr<const peers> others_;
  std::shared_ptr<eyes_port> port_;
  core core_;
};

} // namespace godwit::movement_detector
