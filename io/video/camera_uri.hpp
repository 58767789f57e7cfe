// Where a camera is, as a URI:
//
//   v4l2:///dev/video0?width=1280&height=720&fps=30    a camera of this computer; without the size, what it offers
//   rtsp://[user:password@]host[:port]/path            one on the network
//   file:///folder/flight.mkv                          a recording, at the pace in which it was made
//   test://ball?width=640&height=360&fps=30            a pattern that GStreamer draws; for tests, also with what a
//   camera
//                                                      can do: stop_after=N, hang_after=N, resize_after=N (frames)
//
// Errors: a sentence. Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::io::video {

enum class camera_kind { device, network, file, test };

struct camera_uri {
  camera_kind kind = camera_kind::test;
  std::string where;         // device: its path; network and file: the URI; test: the pattern
  std::int32_t width_px = 0; // 0: as it comes
  std::int32_t height_px = 0;
  std::int32_t frames_per_s = 0;
  std::int64_t stop_after = 0; // of a test: frames; 0: never
  std::int64_t hang_after = 0;
  std::int64_t resize_after = 0;
};

[[nodiscard]] tl::expected<camera_uri, std::string> parse_camera_uri(std::string_view text);

// Of a file with any name, which may hold what a URI may not. PATH is absolute.
[[nodiscard]] camera_uri recording_at(std::string_view path);

// Of a file: where it lies.
[[nodiscard]] std::string path_of(const camera_uri& file);

// TEXT without a password, for people.
[[nodiscard]] std::string without_password(std::string_view text);

} // namespace godwit::io::video
