// What people are told of points of interest, short enough for a ground station. Pure. Thread: any.
#pragma once

#include <string>

#include "messages/scan_controller/point.hpp"

namespace godwit::executor {

// "point 3: vehicle, 90 %, at 47.39810,8.54610; decide within 60 s"
[[nodiscard]] std::string sentence_about(const scan_controller::point_shown& m);
// "point 3 is confirmed by anna"
[[nodiscard]] std::string sentence_about(const scan_controller::point_closed& m);

} // namespace godwit::executor
