// The landing watch as an actor: hears the vehicle, and asks the guardian while it stands.
//
// It runs whatever the executor's table says. Nothing of it is durable: a new incarnation waits anew. Errors: none; an
// answer that does not come is asked for again. Thread: as actor_base.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "programs/godwitd/landing_watch/core.hpp"
#include "programs/godwitd/landing_watch/messages.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/supervision/handle.hpp"

namespace godwit::landing_watch {

// Ends the process in order. May be called by any thread and does not block.
using process_end = std::function<void(const std::string& why)>;

class actor final : public runtime::actor_base<own_handle> {
public:
  static constexpr std::chrono::seconds tick_period{2};
  static constexpr std::chrono::seconds answer_timeout{2};

  // OF: without whom the process is to end.
  actor(runtime::spawn_context context, runtime::guardian_handle guardian, std::string of, process_end end);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override { tell_after(tick_period, me(), tick{incarnation_number()}); }

private:
  void look();

  runtime::guardian_handle guardian_;
  std::string of_;
  process_end end_;
  core core_;
};

} // namespace godwit::landing_watch
