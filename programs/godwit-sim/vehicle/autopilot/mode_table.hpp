// The flight modes of each autopilot: names, numbers, and what they come down to. Thread: constants.
//
// Source: ArduPilot's Copter and Plane modes, PX4's px4_custom_mode (main mode << 16, sub mode << 24), and HEARTBEATs
// that were recorded from both.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace godwit::sim {

enum class mode_kind {
  manual, // a pilot's; without one it comes to a stop and stays
  hold,
  guided, // holds, and goes where it is told
  mission,
  come_back,
  land,
  take_off,
};

struct flight_mode {
  std::string_view name;
  std::uint32_t custom = 0;
  std::uint8_t base = 0; // bits of HEARTBEAT.base_mode, without the one that says that it is armed
  mode_kind kind{};
  bool needs_position = false;
};

using mode_table = std::span<const flight_mode>;

[[nodiscard]] mode_table rover_modes();
[[nodiscard]] mode_table px4_modes();
[[nodiscard]] mode_table copter_modes();
[[nodiscard]] mode_table plane_modes();
[[nodiscard]] mode_table quadplane_modes();
[[nodiscard]] mode_table ardurover_modes();

// PX4's number for a main and a sub mode.
[[nodiscard]] constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub) {
  return main << 16U | sub << 24U;
}

// None: there is no such mode.
[[nodiscard]] const flight_mode* find_mode(mode_table modes, std::uint32_t custom);
// The first of that kind. Each table has one of each kind that is asked for.
[[nodiscard]] const flight_mode& mode_of_kind(mode_table modes, mode_kind kind);
[[nodiscard]] bool has_mode_of_kind(mode_table modes, mode_kind kind);

} // namespace godwit::sim
