#include "tests/example/actors/odometer/actor.hpp"

namespace godwit::odometer {

actor::behavior_type actor::handlers() {
  return {on_event<moved>(), on_request<reset, reset_done>(),
          on<get_total>([this](const get_total&) { return total{current_state().total_m}; })};
}

void actor::dispatch(const effect& each) {
  if (const auto* full = std::get_if<milestone>(&each))
    tell(listener_, *full);
}

} // namespace godwit::odometer
