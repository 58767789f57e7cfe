// A request on its way through the service: who may ask was looked at, and where it goes is known. Thread: values.
#pragma once

#include <cstdint>

#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/route.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

struct call {
  const request& asked;
  const route& to;
  const mission_row& mission; // is there, and not deleted
  std::int64_t now_ns = 0;    // since 1970
};

using call_handler = answer (*)(service_file& file, const call& at);

} // namespace godwit::sim::missions
