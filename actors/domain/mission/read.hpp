// Text from outside to a checked value: bounds, JSON, version, schema, fields, and the rules between the fields.
//
//   const auto mission = read<document>(body);
//   if (!mission) log(mission.error().message()); // "/items/3/at/latitude is 95; allowed: a number from -90 to 90"
//
// What comes back keeps every rule of config/schemas and of rules.hpp. What another minor version added is refused as
// unknown all the same: nothing of a mission is ever dropped in silence. Thread: pure.
#pragma once

#include <cstddef>
#include <string_view>

#include <tl/expected.hpp>

#include "actors/domain/mission/error.hpp"
#include "actors/domain/mission/judge.hpp"
#include "messages/mission/answer.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::mission {

inline constexpr std::size_t max_mission_bytes = 16 * 1024 * 1024; // 10,000 items of kind survey with 20,000 corners
inline constexpr std::size_t max_page_bytes = 2 * 1024 * 1024;     // 2,000 map objects of 400 bytes, doubled
inline constexpr std::size_t max_batch_bytes = 1024 * 1024;        // 500 rows, doubled twice
inline constexpr std::size_t max_answer_bytes = 64 * 1024;
inline constexpr std::size_t max_bundle_bytes = 128 * 1024 * 1024; // a file of 200,000 map objects

// How each kind of document is read.
struct document_form {
  std::string_view schema; // in config/schemas
  std::size_t max_bytes = 0;
  judge by = judge::valijson;
  bool is_open = false; // properties that we do not know are passed over; only the problem of RFC 9457
};

template <class T>
inline constexpr document_form form_of{};
template <>
inline constexpr document_form form_of<document>{"mission", max_mission_bytes};
template <>
inline constexpr document_form form_of<assignment>{"assignment", max_mission_bytes};
template <>
inline constexpr document_form form_of<assignment_list>{"assignment_list", max_mission_bytes};
template <>
inline constexpr document_form form_of<assignment_response>{"assignment_response", max_answer_bytes};
template <>
inline constexpr document_form form_of<waypoint_insert>{"waypoint_insert", max_answer_bytes};
template <>
inline constexpr document_form form_of<tail>{"tail", max_mission_bytes};
template <>
inline constexpr document_form form_of<progress_report>{"progress_report", max_answer_bytes};
template <>
inline constexpr document_form form_of<progress_batch>{"progress", max_batch_bytes, judge::for_rows};
template <>
inline constexpr document_form form_of<map_object_page>{"map_object_page", max_page_bytes, judge::for_rows};
template <>
inline constexpr document_form form_of<ignored_item_page>{"ignored_item_page", max_page_bytes, judge::for_rows};
template <>
inline constexpr document_form form_of<observation_batch>{"observation_batch", max_batch_bytes, judge::for_rows};
template <>
inline constexpr document_form form_of<ignored_item_batch>{"ignored_item_batch", max_batch_bytes, judge::for_rows};
template <>
inline constexpr document_form form_of<observation_picture>{"observation_picture", max_answer_bytes};
template <>
inline constexpr document_form form_of<map_object_bundle>{"map_object_bundle", max_bundle_bytes, judge::for_rows};
template <>
inline constexpr document_form form_of<receipt>{"receipt", max_answer_bytes};
template <>
inline constexpr document_form form_of<progress_status>{"progress_status", max_answer_bytes};
template <>
inline constexpr document_form form_of<next_mission>{"next_mission", max_answer_bytes};
template <>
inline constexpr document_form form_of<problem>{"problem", max_answer_bytes, judge::valijson, true};

template <class T>
using read_result = tl::expected<T, document_error>;

// Defined for each T that has a form.
template <class T>
[[nodiscard]] read_result<T> read(std::string_view text);

} // namespace godwit::mission
