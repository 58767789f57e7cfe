#include "actors/domain/flight_mode/flight_modes.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "io/mavlink/enums.hpp"

namespace godwit::flight {
namespace {

using io::mavlink::mav_autopilot;

struct row {
  std::uint32_t number = 0;
  mode_kind kind = mode_kind::unknown;
};

// PX4: main mode << 16 | sub mode << 24.
constexpr std::uint32_t px4(std::uint32_t main, std::uint32_t sub = 0) { return main << 16U | sub << 24U; }

// The first of a kind is the one that is asked for.
constexpr std::array px4_modes{
    row{px4(1), mode_kind::manual},     row{px4(2), mode_kind::manual},       row{px4(3), mode_kind::manual},
    row{px4(3, 1), mode_kind::manual},  row{px4(3, 2), mode_kind::manual},    row{px4(5), mode_kind::manual},
    row{px4(6), mode_kind::guided},     row{px4(7), mode_kind::manual},       row{px4(8), mode_kind::manual},
    row{px4(4, 3), mode_kind::hold},    row{px4(4, 1), mode_kind::hold},      row{px4(4, 2), mode_kind::take_off},
    row{px4(4, 4), mode_kind::mission}, row{px4(4, 5), mode_kind::returning}, row{px4(4, 6), mode_kind::landing},
    row{px4(4, 8), mode_kind::guided},  row{px4(4, 9), mode_kind::landing},   row{px4(4, 10), mode_kind::take_off},
};

constexpr std::array copter_modes{
    row{0, mode_kind::manual},    row{1, mode_kind::manual},     row{2, mode_kind::manual},
    row{3, mode_kind::mission},   row{4, mode_kind::guided},     row{17, mode_kind::hold}, // BRAKE ignores the sticks
    row{5, mode_kind::hold},      row{16, mode_kind::hold},      row{7, mode_kind::hold},
    row{6, mode_kind::returning}, row{21, mode_kind::returning}, row{27, mode_kind::returning},
    row{9, mode_kind::landing},   row{11, mode_kind::manual},    row{13, mode_kind::manual},
    row{14, mode_kind::manual},   row{15, mode_kind::manual},    row{18, mode_kind::take_off},
    row{19, mode_kind::guided},   row{20, mode_kind::guided},    row{22, mode_kind::manual},
    row{23, mode_kind::guided},   row{24, mode_kind::manual},    row{25, mode_kind::manual},
    row{26, mode_kind::manual},
};

constexpr std::array plane_modes{
    row{0, mode_kind::manual},     row{2, mode_kind::manual},   row{3, mode_kind::manual},
    row{4, mode_kind::manual},     row{5, mode_kind::manual},   row{6, mode_kind::manual},
    row{7, mode_kind::manual},     row{8, mode_kind::manual},   row{12, mode_kind::hold},
    row{1, mode_kind::hold},       row{10, mode_kind::mission}, row{11, mode_kind::returning},
    row{21, mode_kind::returning}, row{15, mode_kind::guided},  row{14, mode_kind::guided},
    row{13, mode_kind::take_off},  row{20, mode_kind::landing}, row{17, mode_kind::manual},
    row{18, mode_kind::manual},    row{19, mode_kind::hold},    row{22, mode_kind::manual},
    row{23, mode_kind::manual},    row{24, mode_kind::manual},
};

constexpr std::array rover_modes{
    row{0, mode_kind::manual},   row{1, mode_kind::manual},     row{3, mode_kind::manual},
    row{7, mode_kind::manual},   row{4, mode_kind::hold},       row{5, mode_kind::hold},
    row{10, mode_kind::mission}, row{11, mode_kind::returning}, row{12, mode_kind::returning},
    row{15, mode_kind::guided},  row{6, mode_kind::guided},     row{16, mode_kind::hold},
};

std::span<const row> table_of(const mode_owner& whose) {
  if (whose.autopilot == mav_autopilot::px4)
    return px4_modes;
  switch (whose.vehicle) {
  case vehicle_class::multirotor:
    return copter_modes;
  case vehicle_class::fixed_wing:
    return plane_modes;
  case vehicle_class::rover:
    return rover_modes;
  case vehicle_class::unknown:
    break;
  }
  return {};
}

} // namespace

mode_owner owner_of(const io::mavlink::heartbeat& m) {
  return {static_cast<mav_autopilot>(m.autopilot), class_of(static_cast<io::mavlink::mav_type>(m.type))};
}

flight_mode mode_of(const mode_owner& whose, std::uint32_t custom_mode) {
  const auto table = table_of(whose);
  const auto found = std::find_if(table.begin(), table.end(), [&](const row& r) { return r.number == custom_mode; });
  return {found == table.end() ? mode_kind::unknown : found->kind, custom_mode};
}

flight_mode mode_of(const io::mavlink::heartbeat& m) { return mode_of(owner_of(m), m.custom_mode); }

std::optional<std::uint32_t> number_of(const mode_owner& whose, mode_kind kind) {
  const auto table = table_of(whose);
  const auto found = std::find_if(table.begin(), table.end(), [&](const row& r) { return r.kind == kind; });
  if (kind == mode_kind::unknown || found == table.end())
    return std::nullopt;
  return found->number;
}

std::optional<vehicle_link::send_command> mode_command(const mode_owner& whose, mode_kind kind) {
  const auto number = number_of(whose, kind);
  return number ? std::optional(mode_command(whose, *number)) : std::nullopt;
}

vehicle_link::send_command mode_command(const mode_owner& whose, std::uint32_t custom_mode) {
  vehicle_link::send_command result;
  result.command = io::mavlink::number(io::mavlink::mav_cmd::do_set_mode);
  result.param1 = static_cast<float>(io::mavlink::number(io::mavlink::mav_mode_flag::custom_mode_enabled));
  if (whose.autopilot == mav_autopilot::px4) {
    result.param2 = static_cast<float>(custom_mode >> 16U & 0xFFU);
    result.param3 = static_cast<float>(custom_mode >> 24U);
  } else {
    result.param2 = static_cast<float>(custom_mode);
  }
  return result;
}

} // namespace godwit::flight
