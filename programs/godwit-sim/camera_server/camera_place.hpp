// Where the camera of a simulated vehicle is served, and what it sees:
//
//   rtsp://127.0.0.1:8554/camera?width=640&height=360&fps=10&seed=7&movers=4&north=100&east=40&spread=120
//
// The movers drive and walk within `spread` metres of a place so far north and east of home. Errors: a sentence.
// Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::sim {

struct camera_place {
  std::string host = "127.0.0.1";
  std::uint16_t port = 8554;
  std::string path = "/camera";
  std::int64_t width = 640;
  std::int64_t height = 360;
  std::int64_t fps = 10;
  std::int64_t focal_px = 554; // a field of view of 60 degrees
  std::int64_t seed = 7;
  std::int64_t movers = 4;
  std::int64_t north_m = 100;
  std::int64_t east_m = 40;
  std::int64_t spread_m = 60;
};

[[nodiscard]] tl::expected<camera_place, std::string> parse_camera_place(std::string_view text);

} // namespace godwit::sim
