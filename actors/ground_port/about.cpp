#include "actors/ground_port/about.hpp"

namespace godwit::ground_port {

namespace {

// MAV_PROTOCOL_CAPABILITY
constexpr std::uint64_t param_float = 2;
constexpr std::uint64_t mission_int = 4;
constexpr std::uint64_t command_int = 8;
constexpr std::uint64_t mavlink2 = 8'192;
constexpr std::uint64_t mission_fence = 16'384;
constexpr std::uint64_t mission_rally = 32'768;

constexpr std::uint64_t ours = param_float | mission_int | command_int | mavlink2 | mission_fence | mission_rally;

// Versions are counted in hundredths; version 1 is not spoken here.
constexpr std::uint16_t version_2 = 200;

} // namespace

mavlink::autopilot_version version_to_show(const std::optional<mavlink::autopilot_version>& vehicle) {
  auto result = vehicle.value_or(mavlink::autopilot_version{});
  result.capabilities = ours;
  return result;
}

mavlink::protocol_version protocol_to_show() {
  return {.version = version_2, .min_version = version_2, .max_version = version_2};
}

std::vector<vehicle_role::param> params_to_show(mavlink::sender ourselves) {
  const auto system = static_cast<float>(ourselves.system);
  return {{"MAV_SYS_ID", system}, {"MAV_COMP_ID", static_cast<float>(ourselves.component)}, {"SYSID_THISMAV", system}};
}

} // namespace godwit::ground_port
