// The line of vehicle_link. Thread: as line_port.
#pragma once

#include "actors/line/line_port.hpp"
#include "messages/vehicle_link/handle.hpp"

namespace godwit::vehicle_link {

using link_port = line::line_port<wake_handle, wake>;

} // namespace godwit::vehicle_link
