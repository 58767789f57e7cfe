// A plan file of lines (`QGC WPL 110`) to a mission; the items as item_import.hpp says.
//
// The first line is the home position, as ground stations write it, when it is a waypoint without parameters in the
// frame of sea level; it becomes the return point. A file without one needs a return point from the caller, else the
// place of its first item is taken, which is a loss. A file of lines has neither fence nor rally points. Errors: as
// values. Thread: pure.
#pragma once

#include <string_view>

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

[[nodiscard]] import_result import_waypoints(std::string_view text, const import_options& options = {});

} // namespace godwit::mission
