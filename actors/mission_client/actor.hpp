// mission_client as an actor: everything between godwit and the missions service.
//
// The durable decisions are in core.hpp, what is to be done next in planner.hpp. This shell takes what others say and
// the answers of the service, commits the events that come of it, and executes the planner's requests: calls to the
// service through its port, questions to the map store. Calls of an incarnation that died are forgotten; the next one
// makes them again under the same keys. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "actors/mission_client/clock_watch.hpp"
#include "actors/mission_client/core.hpp"
#include "actors/mission_client/outbox/recorded_answer.hpp"
#include "actors/mission_client/planner.hpp"
#include "actors/mission_client/service_port.hpp"
#include "actors/mission_client/settings.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "messages/mission_client/handle.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::mission_client {

// The map store writes 100,000 objects within this; later the same is asked again.
inline constexpr std::chrono::seconds store_patience{30};
// Rows in the journal's table of deliveries that are there only to be looked at.
inline constexpr std::int64_t max_resolved_rows_shown = 1'000;

// Whom it speaks with. Filled in while the process is composed, when the addresses of all actors exist, and not changed
// after the actors were started.
struct peers {
  listener_handle listener; // the one who flies
  mapobjects_store::client_handle map;
};

class actor final : public runtime::durable_actor<own_handle, durable_core> {
public:
  static constexpr int max_plans_per_turn = 1'000;

  // CONFIGURED has no objection_to. SEED: another one for each process, for keys that nobody else makes.
  actor(runtime::spawn_context context, settings configured, std::shared_ptr<service_port> service,
        std::shared_ptr<const peers> others, std::uint64_t seed);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void on_deadline() override;
  void dispatch(const durable_core::effect& each) override;
  bool stage(const durable_core::effect& each, runtime::journal_write& write) override;

private:
  [[nodiscard]] instant now() const { return {now_ns(), wall_ns()}; }
  template <class M>
  auto hears();
  void decision_context();
  void take_answers();
  [[nodiscard]] std::optional<service_news> next_answer();
  [[nodiscard]] service_news news_of_call(service_answer answer);
  void plan();
  void execute(requests wanted);
  void ask_store(ticket number, const store_question& asked);
  void post_health();
  [[nodiscard]] service_status status() const;

  settings settings_;
  std::shared_ptr<service_port> service_;
  std::shared_ptr<const peers> others_;
  std::uint64_t seed_;
  std::optional<planner> planner_;
  clock_watch clock_;
  std::map<std::uint64_t, ticket> calls_; // under way, by the port's number; bounded by the planner
  std::uint64_t stray_answers_ = 0;       // to calls that nobody waits for any more
};

} // namespace godwit::mission_client
