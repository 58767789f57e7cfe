// A process with mission_client, a scripted map store and somebody who listens; the scripted service stands outside.
//
// Destroying a process is SIGKILL; the disk, the store's file, the service and what was heard outlive it. Thread: one.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "actors/mission_client/actor.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/actors/mission_client/scripted_service.hpp"
#include "tests/actors/mission_client/scripted_store.hpp"

namespace godwit::mission_client::test {

// What the one who flies was told, outside of it, where no crash reaches it.
struct heard {
  std::vector<mission_loaded> loaded;
  std::vector<earlier_found> earlier;
  std::vector<mission_refused> refused;
  std::vector<map_pulled> pulled;
  std::vector<change_outcome> outcomes;
  std::vector<assignment_arrived> arrived;
  std::vector<mission_deleted> deleted;
  std::vector<mission_resolved> resolved;
};

class listener final : public runtime::actor_base<listener_handle> {
public:
  listener(runtime::spawn_context context, heard* into) : actor_base(std::move(context)), into_(into) {}

protected:
  behavior_type handlers() override;

private:
  heard* into_;
};

struct outside {
  runtime::simulated_disk disk;
  scripted_service service;
  scripted_store store;
  heard listener;
  std::uint64_t processes = 0; // each has a seed of its own
};

class process {
public:
  explicit process(outside& around, settings configured = {});

  void advance(std::chrono::nanoseconds duration, std::chrono::nanoseconds stride = std::chrono::milliseconds(10));
  // Gives the service and the client what they have for each other, without time passing.
  void exchange();
  template <class M>
  void say(M message) {
    world.tell(client, std::move(message));
  }
  [[nodiscard]] service_status status();
  [[nodiscard]] retry_answer retry(const std::string& key = {});
  // What the health board says of it.
  [[nodiscard]] runtime::health_entry health() const;

  runtime::simulation world;
  std::shared_ptr<scripted_port> port = std::make_shared<scripted_port>();
  own_handle client;

private:
  outside& around_;
};

// begin_mission and all that comes of it.
void begin(process& p, const std::string& mission_id);

[[nodiscard]] report_progress report(const std::string& mission_id, std::uint32_t number);
[[nodiscard]] insert_waypoint insert(const std::string& mission_id, std::int32_t base, std::uint64_t number);
[[nodiscard]] replace_tail tail(const std::string& mission_id, std::int32_t base, std::uint64_t number);
[[nodiscard]] respond_to_assignment response(const std::string& mission_id, const mission::assignment& to,
                                             mission::assignment_outcome outcome, std::uint64_t number);

} // namespace godwit::mission_client::test
