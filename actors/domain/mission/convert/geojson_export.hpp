// A mission as GeoJSON (RFC 7946), for maps. Nothing is lost, and what was written here can be read again.
//
//   FeatureCollection          "godwit": mission_id, schema_version, revision
//     role "item"              one for each item in order: a point, a survey's polygon, or no geometry; the item's
//     other
//                              fields are properties
//     role "geofence"          polygon; kind, floor_m and ceiling_m are properties
//     role "return_point"      point
//     role "path"              the way from item to item, only to look at
//
// Positions are [longitude, latitude, metres above the place of take-off]; RFC 7946 would have them above the
// ellipsoid, which a mission does not know. Rings are counter-clockwise, as the RFC wants, and closed. A polygon over
// the 180th meridian is not cut in two. Thread: pure.
#pragma once

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

// MISSION keeps all rules.
[[nodiscard]] exported export_geojson(const document& mission);

} // namespace godwit::mission
