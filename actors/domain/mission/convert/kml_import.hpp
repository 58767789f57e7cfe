// KML 2.2 and 2.3, as map programs draw it, to a mission: points and paths become waypoints, in the order of the file.
//
//   altitudeMode              height of the waypoints
//   relativeToGround          above the terrain, as it stands there
//   absolute                  above mean sea level, as it stands there
//   none, clampToGround, ...  of no use: the altitude of the options, above home; without one the file is refused
//
// There is no take-off, no landing and no speed in KML. Polygons, tracks, models and links are losses; names, styles,
// views and pictures on the ground mean nothing to a vehicle. A document type declaration is refused: entities can grow
// without a bound. Errors: as values, with the line. Thread: pure. Source: OGC 12-007r2.
#pragma once

#include <string_view>

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

[[nodiscard]] import_result import_kml(std::string_view text, const import_options& options = {});

} // namespace godwit::mission
