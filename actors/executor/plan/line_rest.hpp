// Where a line goes on that was left before its end. Thread: pure.
#pragma once

#include <optional>

#include "actors/domain/geo/point.hpp"
#include "messages/mission/place.hpp"

namespace godwit::executor::plan {

// How far along the line FROM to TO the picture AT lies, in metres. Nothing: at its beginning, or too far beside it to
// be one of this line, which then is flown from its beginning.
[[nodiscard]] std::optional<double> way_along(const geo::point& from, const geo::point& to, const geo::point& at);

// So far along the line, at its height there.
[[nodiscard]] mission::position place_along(const mission::position& from, const mission::position& to, double along_m);

} // namespace godwit::executor::plan
