// What of vehicle_link must survive a crash: how far signing time is used up, and with which vehicle the flight is
// flown that is open. All else is asked of the vehicle again.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::vehicle_link {

// All signing times of this link below the ceiling may have been used. Units: 10 us since 2015-01-01 UTC.
struct signing_time_reserved {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  std::uint64_t ceiling = 0;
  GODWIT_FIELDS(signing_time_reserved, "vehicle_link.signing_time_reserved", ceiling);
};

// The flight that is open is flown with this vehicle: until it is over no other one is taken. None: no flight is open.
struct vehicle_kept {
  std::optional<vehicle_name> who;
  GODWIT_FIELDS(vehicle_kept, "vehicle_link.vehicle_kept", who);
};

struct state {
  std::uint64_t signing_ceiling = 0;
  std::optional<vehicle_name> kept;
  static constexpr int version = 1;
  GODWIT_FIELDS(state, "vehicle_link.state", signing_ceiling, kept);
};

// The durable part: a reservation is an event, and what comes of it is the permission to use it.
struct durable_core {
  using state = vehicle_link::state;
  using event = std::variant<signing_time_reserved, vehicle_kept>;
  using effect = std::variant<signing_time_reserved>;

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t) {
    if (const auto* kept = std::get_if<vehicle_kept>(&happened)) {
      s.kept = kept->who;
      return {};
    }
    const auto& reserved = std::get<signing_time_reserved>(happened);
    if (reserved.ceiling > s.signing_ceiling)
      s.signing_ceiling = reserved.ceiling;
    return {reserved};
  }
  [[nodiscard]] static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
};

} // namespace godwit::vehicle_link
