#include "programs/godwitd/landing_watch/actor.hpp"

#include <utility>

#include "io/mavlink/messages/heartbeat.hpp"
#include "runtime/content_hash.hpp"

namespace godwit::landing_watch {

actor::actor(runtime::spawn_context context, runtime::guardian_handle guardian, std::string of, process_end end)
    : actor_base(std::move(context)), guardian_(std::move(guardian)), of_(std::move(of)), end_(std::move(end)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {on<io::mavlink::heartbeat>(
              [this](const io::mavlink::heartbeat& m) { core_.on_heartbeat(io::mavlink::is_armed(m), now_ns()); }),
          on<tick>([this](const tick& due) {
            if (due.incarnation != incarnation_number())
              return;
            tell_after(tick_period, me(), tick{incarnation_number()});
            look();
          })};
}

// Looked at once more with the answer: it may have been armed since.
void actor::look() {
  if (!core_.stands(now_ns()))
    return;
  ask(
      guardian_, answer_timeout, runtime::get_children{},
      [this](const runtime::children& all) {
        if (!core_.stands(now_ns()) || !is_given_up(all, of_))
          return;
        if (is_recorded())
          note_call("end the process", runtime::empty_hash);
        end_(of_ + " was given up in flight; the vehicle stands disarmed, and the next process begins with one");
      },
      [](const runtime::ask_error&) {});
}

} // namespace godwit::landing_watch
