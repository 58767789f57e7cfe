// The GeoJSON of geojson_export.hpp back to a mission: geometries may have been moved on a map, and count. GeoJSON that
// did not come from there is refused, because nothing in it says what a vehicle is to do.
//
// Errors: as values. Thread: pure.
#pragma once

#include <string_view>

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

[[nodiscard]] import_result import_geojson(std::string_view text, const import_options& options = {});

} // namespace godwit::mission
