// What comes in is looked at once, before it touches the map. An error says which field is wrong. Thread: pure.
#pragma once

#include <cstddef>

#include "actors/mapobjects_store/error.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mapobjects_store {

inline constexpr std::size_t max_class_group_bytes = 64;
inline constexpr std::size_t max_class_groups = 64;
inline constexpr std::size_t max_view_circles = 4096; // an hour of one footprint each second
inline constexpr std::size_t max_view_polygons = 256;
inline constexpr std::size_t max_view_vertices = 256;
inline constexpr double max_view_radius_m = 50'000;

[[nodiscard]] map_result<void> check(const sighting& input);
[[nodiscard]] map_result<void> check(const operator_verdict& input);
[[nodiscard]] map_result<void> check(const pass_end& input);
[[nodiscard]] map_result<void> check(const map_object& input);
// Also brings the name of the cell into its one form.
[[nodiscard]] map_result<ignored_item> checked(ignored_item input);

// An id of a mission or of anything else.
[[nodiscard]] map_result<void> check_id(const std::string& id, const std::string& field);

} // namespace godwit::mapobjects_store
