// What a person can do about a broker that is not there. Thread: pure.
#pragma once

#include <string_view>

#include "messages/fleet_link/types.hpp"

namespace godwit::fleet_link {

// A sentence without a full stop; empty: waiting is all there is to do.
[[nodiscard]] std::string_view remedy_of(broker_failure why);

} // namespace godwit::fleet_link
