// operator_bridge as an actor: between those who bring what operators say and the executor.
//
// The decisions are in core.hpp. This shell commits the notes of a decision as one write, hands a stop over in the same
// turn and anything else when that write is on the disk, and answers. A crash forgets who waits for an answer: whoever
// asks again with the same id hears what is known. Errors: as answers. Thread: as actor_base.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/operator_bridge/core.hpp"
#include "actors/operator_bridge/presence.hpp"
#include "messages/executor/handle.hpp"
#include "messages/operator_bridge/handle.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::operator_bridge {

using executor_handle = runtime::mailbox<runtime::asks<operators::command, operators::answer>>;

class actor final : public runtime::durable_actor<own_handle, durable_core> {
public:
  // The executor answers when the disk has it; together with core::release_within_ns less than those who ask wait.
  static constexpr std::chrono::milliseconds executor_patience{2'000};

  actor(runtime::spawn_context context, const settings& configured, executor_handle executor,
        std::shared_ptr<presence> shown = std::make_shared<presence>(), std::vector<control_listener> listeners = {},
        std::shared_ptr<session_ends> ends = std::make_shared<session_ends>(),
        std::vector<holder_ear> holder_ears = {});
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void on_deadline() override;
  void dispatch(const durable_core::effect&) override {}
  void add_rows(const durable_core::event& happened, runtime::journal_write& write) override;
  [[nodiscard]] bool goes_on_without_disk() const override { return true; } // stops have to come through

private:
  [[nodiscard]] instant now() {
    const auto at = handler_time();
    return {at.monotonic_ns, at.wall_ns};
  }
  // A handler that asks the core, and answers when all that it has decided is on the disk.
  template <class Q, class R>
  auto decides(std::pair<effects, R> (core::*judge)(const Q&, instant));
  void take(const operator_command& m, std::uint64_t request_id);
  void execute(const effects& wanted);
  void execute(const note& each) { commit(each.what); }
  void execute(const hand_over& each);
  void execute(const reply& each);
  void execute(const session_over& each);
  void release(std::uint64_t number);
  void ask_executor(std::uint64_t number, const operators::command& what);
  void plan_deadline();
  void show_presence();
  void tell_control();

  settings settings_;
  executor_handle executor_;
  std::shared_ptr<presence> presence_;
  std::vector<control_listener> listeners_;
  std::shared_ptr<session_ends> ends_;
  std::vector<holder_ear> holder_ears_;
  std::optional<std::string> told_control_; // the name; none: nobody was told yet
  std::optional<core> core_;
};

} // namespace godwit::operator_bridge
