#include "actors/executor/preflight/checks/wall_clock.hpp"
#include "io/time_units.hpp"

namespace godwit::executor::preflight {

namespace {}

result look_at_wall_clock(const facts& seen, const settings& set) {
  if (seen.wall_ns / ns_per_s < set.earliest_date_s)
    return fail("The clock of this computer shows a date of the past; wait until it is set by satellite or network, or "
                "set it by hand.");
  return pass("The clock of this computer is set.");
}

} // namespace godwit::executor::preflight
