// A place of the map's messages as the geodesics take it. Thread: pure.
#pragma once

#include "actors/domain/geo/geodesic.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mapobjects_store {

[[nodiscard]] inline geo::point point_of(const geo_position& at) { return {at.latitude_deg, at.longitude_deg}; }

} // namespace godwit::mapobjects_store
