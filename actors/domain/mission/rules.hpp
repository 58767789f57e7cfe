// What a schema can not say: the rules between the fields of a document. To be asked of documents that have the form.
//
// Items have different ids, jumps lead to items and end where nothing moves, polygons are polygons, a floor lies below
// its ceiling, numbers are finite, times exist, revisions rise, reports follow each other, and the version of the
// contract is one that this program speaks. Thread: pure.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "actors/domain/mission/error.hpp"
#include "messages/mission/answer.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::mission {

inline constexpr std::size_t max_items = 10'000;              // of a mission, as in its schema
inline constexpr std::size_t max_geofences = 100;             // as in its schema
inline constexpr std::size_t max_polygon_corners = 256;       // as in its schema
inline constexpr std::size_t max_corners_in_mission = 20'000; // all polygons together: what judging them may cost

using document_problems = std::vector<document_problem>;

[[nodiscard]] document_problems broken_rules(const document& value);
[[nodiscard]] document_problems broken_rules(const assignment& value);
[[nodiscard]] document_problems broken_rules(const assignment_list& value);
[[nodiscard]] document_problems broken_rules(const assignment_response& value);
[[nodiscard]] document_problems broken_rules(const waypoint_insert& value);
[[nodiscard]] document_problems broken_rules(const tail& value);
[[nodiscard]] document_problems broken_rules(const progress_report& value);
[[nodiscard]] document_problems broken_rules(const progress_batch& value);
[[nodiscard]] document_problems broken_rules(const map_object_page& value);
[[nodiscard]] document_problems broken_rules(const ignored_item_page& value);
[[nodiscard]] document_problems broken_rules(const observation_batch& value);
[[nodiscard]] document_problems broken_rules(const ignored_item_batch& value);
[[nodiscard]] document_problems broken_rules(const observation_picture& value);
[[nodiscard]] document_problems broken_rules(const map_object_bundle& value);
[[nodiscard]] document_problems broken_rules(const receipt& value);
[[nodiscard]] document_problems broken_rules(const progress_status& value);
[[nodiscard]] document_problems broken_rules(const next_mission& value);
[[nodiscard]] document_problems broken_rules(const problem& value);

inline constexpr std::string_view known_versions = "versions 1.x.y and 2.x.y";

// Whether a document with this `schema_version` can be read at all: of a major version that this program speaks.
[[nodiscard]] bool is_known_version(std::string_view version);

} // namespace godwit::mission
