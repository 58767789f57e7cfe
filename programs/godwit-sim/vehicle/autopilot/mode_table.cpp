#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"

#include <algorithm>
#include <array>

#include "runtime/assert.hpp"

namespace godwit::sim {

namespace {

// Bits of base_mode: custom 1, auto 4, guided 8, stabilize 16, manual input 64.
constexpr std::array<flight_mode, 4> rover_table{{
    {"MANUAL", 0, 1 | 64, mode_kind::manual, false},
    {"HOLD", 4, 1, mode_kind::hold, false},
    {"AUTO", 10, 1 | 4 | 8, mode_kind::mission, true},
    {"RTL", 11, 1 | 4 | 8, mode_kind::come_back, true},
}};

constexpr std::uint8_t px4_manual = 1 | 16 | 64;
constexpr std::uint8_t px4_auto = 1 | 4 | 8 | 16;
constexpr std::array<flight_mode, 9> px4_table{{
    {"MANUAL", px4_mode(1, 0), px4_manual, mode_kind::manual, false},
    {"ALTCTL", px4_mode(2, 0), px4_manual, mode_kind::manual, false},
    {"POSCTL", px4_mode(3, 0), px4_manual, mode_kind::manual, true},
    {"STABILIZED", px4_mode(7, 0), px4_manual, mode_kind::manual, false},
    {"AUTO.TAKEOFF", px4_mode(4, 2), px4_auto, mode_kind::take_off, true},
    {"AUTO.LOITER", px4_mode(4, 3), px4_auto, mode_kind::hold, true},
    {"AUTO.MISSION", px4_mode(4, 4), px4_auto, mode_kind::mission, true},
    {"AUTO.RTL", px4_mode(4, 5), px4_auto, mode_kind::come_back, true},
    {"AUTO.LAND", px4_mode(4, 6), px4_auto, mode_kind::land, false},
}};

// Copter tells a ground station that a pilot may always take over.
constexpr std::uint8_t copter_manual = 1 | 16 | 64;
constexpr std::uint8_t copter_guided = copter_manual | 8;
constexpr std::array<flight_mode, 9> copter_table{{
    {"STABILIZE", 0, copter_manual, mode_kind::manual, false},
    {"ALT_HOLD", 2, copter_manual, mode_kind::manual, false},
    {"AUTO", 3, copter_guided, mode_kind::mission, true},
    {"GUIDED", 4, copter_guided, mode_kind::guided, true},
    {"LOITER", 5, copter_guided, mode_kind::hold, true},
    {"RTL", 6, copter_guided, mode_kind::come_back, true},
    {"LAND", 9, copter_manual, mode_kind::land, false},
    {"POSHOLD", 16, copter_guided, mode_kind::hold, true},
    {"BRAKE", 17, copter_guided, mode_kind::hold, true},
}};

// The first of a kind is the one that is asked for.
constexpr std::uint8_t plane_manual = 1 | 64;
constexpr std::uint8_t plane_assisted = 1 | 16 | 64;
constexpr std::uint8_t plane_guided = 1 | 8 | 16;
constexpr std::array<flight_mode, 18> quadplane_table{{
    {"MANUAL", 0, plane_manual, mode_kind::manual, false},
    {"STABILIZE", 2, plane_assisted, mode_kind::manual, false},
    {"TRAINING", 3, plane_assisted, mode_kind::manual, false},
    {"ACRO", 4, plane_assisted, mode_kind::manual, false},
    {"FBWA", 5, plane_assisted, mode_kind::manual, false},
    {"FBWB", 6, plane_assisted, mode_kind::manual, false},
    {"CRUISE", 7, plane_assisted, mode_kind::manual, false},
    {"AUTOTUNE", 8, plane_assisted, mode_kind::manual, false},
    {"AUTO", 10, plane_guided, mode_kind::mission, true},
    {"RTL", 11, plane_guided, mode_kind::come_back, true},
    {"LOITER", 12, plane_guided, mode_kind::hold, true},
    {"CIRCLE", 1, plane_guided, mode_kind::hold, false},
    {"TAKEOFF", 13, plane_guided, mode_kind::take_off, true},
    {"GUIDED", 15, plane_guided, mode_kind::guided, true},
    {"THERMAL", 24, plane_guided, mode_kind::hold, true},
    {"QSTABILIZE", 17, plane_assisted, mode_kind::manual, false},
    {"QHOVER", 18, plane_assisted, mode_kind::manual, false},
    {"QLAND", 20, plane_guided, mode_kind::land, false},
}};
constexpr std::size_t rotor_modes = 3; // the last ones

// MANUAL with a pilot's sticks, HOLD and AUTO as recorded: 65, 1 and 9, and 128 where it is armed.
constexpr std::uint8_t ardurover_auto = 1 | 8;
constexpr std::array<flight_mode, 8> ardurover_table{{
    {"MANUAL", 0, 1 | 64, mode_kind::manual, false},
    {"ACRO", 1, 1 | 16 | 64, mode_kind::manual, false},
    {"STEERING", 3, 1 | 16 | 64, mode_kind::manual, true},
    {"HOLD", 4, 1, mode_kind::hold, false},
    {"LOITER", 5, ardurover_auto, mode_kind::hold, true},
    {"AUTO", 10, ardurover_auto, mode_kind::mission, true},
    {"RTL", 11, ardurover_auto, mode_kind::come_back, true},
    {"GUIDED", 15, ardurover_auto, mode_kind::guided, true},
}};

const flight_mode* first_of(mode_table modes, mode_kind kind) {
  const auto found = std::find_if(modes.begin(), modes.end(), [&](const flight_mode& m) { return m.kind == kind; });
  return found == modes.end() ? nullptr : &*found;
}

} // namespace

mode_table rover_modes() { return rover_table; }
mode_table px4_modes() { return px4_table; }
mode_table copter_modes() { return copter_table; }
mode_table plane_modes() { return mode_table(quadplane_table).first(quadplane_table.size() - rotor_modes); }
mode_table quadplane_modes() { return quadplane_table; }
mode_table ardurover_modes() { return ardurover_table; }

const flight_mode* find_mode(mode_table modes, std::uint32_t custom) {
  const auto found = std::find_if(modes.begin(), modes.end(), [&](const flight_mode& m) { return m.custom == custom; });
  return found == modes.end() ? nullptr : &*found;
}

const flight_mode& mode_of_kind(mode_table modes, mode_kind kind) {
  const auto* found = first_of(modes, kind);
  GODWIT_ASSERT(found != nullptr, "an autopilot changes only to modes that it has");
  return *found;
}

bool has_mode_of_kind(mode_table modes, mode_kind kind) { return first_of(modes, kind) != nullptr; }

} // namespace godwit::sim
