// The line of ground_port. Thread: as line_port.
#pragma once

#include "actors/line/line_port.hpp"
#include "messages/ground_port/handle.hpp"

namespace godwit::ground_port {

using link_port = line::line_port<wake_handle, wake>;

} // namespace godwit::ground_port
