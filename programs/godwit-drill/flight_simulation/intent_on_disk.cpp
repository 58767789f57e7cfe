#include "programs/godwit-drill/flight_simulation/intent_on_disk.hpp"

#include <algorithm>

#include "actors/executor/state.hpp"
#include "runtime/stored_state.hpp"
#include "runtime/variant_json.hpp"

namespace godwit::drill {

intent_on_disk read_intent(const runtime::recovered& executor) {
  using executor::durable_core;
  executor::state found;
  if (executor.snapshot)
    found = runtime::read_state<durable_core>("executor", *executor.snapshot);
  for (const auto& each : executor.events)
    if (std::ranges::find(durable_core::retired, each.type) == durable_core::retired.end())
      (void)durable_core::apply(found, runtime::read_alternative<durable_core::event>("executor", each.type, each.body),
                                each.at_ns);
  return {found.progress.upload.has_value(), found.progress.start.has_value()};
}

} // namespace godwit::drill
