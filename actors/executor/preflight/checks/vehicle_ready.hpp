// Fails while the vehicle's estimator does not know where it is: it can not be armed then for a flight by a plan, or is
// refused its mission mode, also where the autopilot's own checks pass already (ArduPilot: some 16 s before). Skipped
// for a vehicle that does not tell, and while it is not heard. Thread: pure.
//
// Source: EKF_STATUS_REPORT (193) of ardupilotmega.xml, ESTIMATOR_STATUS (230) of common.xml; ArduPilot's
// "Need Position Estimate".
#pragma once

#include <cstdint>

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_vehicle_ready(const facts& seen, const settings& set);

// FLAGS of either message.
[[nodiscard]] estimate estimate_of(std::uint16_t flags);

// Whether this autopilot has a message for it at all, so that it is waited for.
[[nodiscard]] bool tells_estimate(io::mavlink::mav_autopilot autopilot);

} // namespace godwit::executor::preflight
