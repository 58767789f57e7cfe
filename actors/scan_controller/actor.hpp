// Points of interest as an actor: takes candidates, gives each its turn, takes what people decide, and tells the map.
//
// The decisions are in core.hpp and pass_watch.hpp. This shell asks them, commits the facts, and answers when they are
// on the disk. What a person has decided, and what was in view in a whole pass, is owed to the map and asked again,
// with the same id, until the map has it. It sends the vehicle nothing. Errors: in the answers. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "actors/scan_controller/core.hpp"
#include "actors/scan_controller/pass_watch.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "messages/scan_controller/handle.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::scan_controller {

// What of the map it needs.
using map_handle = runtime::mailbox<runtime::asks<mapobjects_store::operator_verdict, mapobjects_store::verdict_answer>,
                                    runtime::asks<mapobjects_store::pass_end, mapobjects_store::pass_answer>>;

// Filled in while the process is composed, before the actors start.
struct peers {
  map_handle map;
  std::vector<subscriber_handle> subscribers;
  // For people. May be called by any thread and does not block.
  std::function<void(const std::string& sentence, bool is_warning)> say;
};

class actor final : public runtime::durable_actor<own_handle, durable_core> {
public:
  static constexpr std::chrono::seconds map_patience{10};
  static constexpr std::int64_t map_retry_ns = 2'000'000'000;

  // PROCESS: another number in each process.
  actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
        std::uint64_t process);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void dispatch(const durable_core::effect& each) override;
  void on_deadline() override { turn(); }

private:
  [[nodiscard]] instant now() {
    const auto at = handler_time();
    return {at.monotonic_ns, at.wall_ns};
  }
  void take(const candidate& seen, std::uint64_t request_id);
  void take(const decide_point& said, std::uint64_t request_id);
  void take(const survey_progress& seen);
  void look_at_view();
  void lose_pass(const pass_lost& how);
  void turn();
  void deliver();
  template <class Owed, class Answer, class Delivered>
  void ask_map(const Owed& what);
  void post_health();

  settings settings_;
  std::shared_ptr<const peers> others_;
  std::uint64_t process_;
  core core_;
  view_watch view_;
  bool is_asking_map_ = false;
  std::int64_t ask_map_from_ns_ = 0; // not before
  std::string map_error_;            // of the last time; empty: it took it
};

} // namespace godwit::scan_controller
