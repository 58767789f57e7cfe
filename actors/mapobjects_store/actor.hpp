// The map as an actor: others say what they have seen, pull and deliver, and hear the answer when it is on the disk.
//
// The decisions are functions of map_tables, made inside the transaction that makes them durable, by the writer of the
// map. This shell hands asks over, gives the answers to those who wait, and tells the health board how the map is. A
// crash loses nothing that was handed over: who waited is told that the outcome is not known, and asks again with the
// same id. Its durable state is the map's own file, so it keeps none in the journal. Errors: in the answers. Thread: as
// actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "actors/mapobjects_store/map_health.hpp"
#include "actors/mapobjects_store/map_port.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::mapobjects_store {

class actor final : public runtime::actor_base<own_handle> {
public:
  // So often it is looked at how the map is, when something has changed.
  static constexpr std::chrono::seconds look_period{5};

  // So many answers are given in one turn, before other mail has its own.
  static constexpr int max_answers_per_turn = 256;

  actor(runtime::spawn_context context, std::shared_ptr<map_port> port);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;

private:
  // Handlers for asks of Q, answered with an A that FILL makes of what was found. The first one for WORK(map_tables&,
  // const Q&), which gives a map_result; the second one for whatever else can be handed over.
  template <class Q, class A, class Work, class Fill>
  auto on_change(Work work, Fill fill);
  template <class Q, class A, class Value, class Start, class Fill>
  auto on_ask(Start start, Fill fill);

  void give_answers();
  template <class Answer>
  void give(std::uint64_t request_id, const Answer& answer);
  void look_at_map();
  void post_health();

  std::shared_ptr<map_port> port_;
  std::optional<map_status> known_;        // when it was looked at last
  std::optional<std::uint64_t> looked_at_; // changes of the map by then
};

} // namespace godwit::mapobjects_store
