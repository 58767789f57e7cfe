// Rows of the map in the form of the map store and in that of the service. Thread: pure.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "messages/mapobjects_store/types.hpp"
#include "messages/mission/map_objects.hpp"

namespace godwit::mission_client {

[[nodiscard]] mission::observation_batch observations_of(const mapobjects_store::batch& rows);
[[nodiscard]] mission::ignored_item_batch ignored_items_of(const mapobjects_store::batch& rows);

// The rows of a page that keeps its schema; the times in it are of the form that utc_text knows.
template <class T>
using rows_result = tl::expected<std::vector<T>, std::string>; // the error is a sentence for people

[[nodiscard]] rows_result<mapobjects_store::map_object> objects_of(const mission::map_object_page& page,
                                                                   const std::string& mission_id);
[[nodiscard]] rows_result<mapobjects_store::ignored_item> ignored_items_of(const mission::ignored_item_page& page,
                                                                           const std::string& mission_id);

} // namespace godwit::mission_client
