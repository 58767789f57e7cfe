#include "programs/godwitd/flight_state.hpp"

#include <exception>

#include "actors/executor/state.hpp"
#include "runtime/stored_state.hpp"
#include "runtime/variant_json.hpp"

namespace godwit::daemon {

bool is_in_flight(const runtime::recovered& executor) {
  using executor::durable_core;
  using executor::phase_status;
  try {
    bool result =
        executor.snapshot && runtime::read_state<durable_core>("executor", *executor.snapshot).status.in_flight;
    for (const auto& each : executor.events)
      if (each.type == phase_status::fields.type_name)
        result =
            std::get<phase_status>(runtime::read_alternative<durable_core::event>("executor", each.type, each.body))
                .in_flight;
    return result;
  } catch (const std::exception&) {
    return false;
  }
}

} // namespace godwit::daemon
