// One pipeline of GStreamer, from a camera to pictures in I420. Made, played and ended by one thread; see source.hpp.
//
// Errors: sentences with a remedy where one is known. Thread: `on_picture` is called in GStreamer's threads.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <gst/gst.h>
#include <tl/expected.hpp>

#include "io/video/camera_uri.hpp"
#include "io/video/frame.hpp"

namespace godwit::io::video {

class pipeline {
public:
  using picture_taker = std::function<void(frame picture)>;

  [[nodiscard]] static tl::expected<std::unique_ptr<pipeline>, std::string> make(const camera_uri& from, bool is_paced,
                                                                                 picture_taker on_picture);
  ~pipeline(); // may block as long as a driver does
  pipeline(const pipeline&) = delete;
  pipeline& operator=(const pipeline&) = delete;

  [[nodiscard]] tl::expected<void, std::string> play(); // may block as long as a driver does

  struct news {
    bool has_ended = false;
    std::string error; // empty: none
  };
  // Waits for so long.
  [[nodiscard]] std::optional<news> wait(std::chrono::milliseconds most);

private:
  struct parts;
  explicit pipeline(std::unique_ptr<parts> made);
  std::unique_ptr<parts> parts_;
};

// Refuses pictures that are too large before there is memory for them.
//
// A stream of a few kB can announce pictures of gigabytes. A decoder that asks on its source pad who has memory for
// such pictures is given a pool that has none, and the reason is the pipeline's error. What a decoder keeps for itself
// before it asks (a progressive JPEG as a whole) is not seen here: for that godwit-eyes has a bound for the process.
//
// Thread: that of the pipeline's owner; the check runs in GStreamer's threads.
// Source: GStreamer 1.22, gst_pad_add_probe, GST_QUERY_ALLOCATION, gst_video_decoder_allocate_output_frame.

// Cameras have up to 5,472 x 3,078. A picture of this area has 25 MB as I420, and a pipeline holds some ten.
inline constexpr int max_side_px = 8'192;
inline constexpr int max_area_px = 4'096 * 4'096;

// WHOLE: before it plays; its element named `convert` gets what all decoders and cameras give.
void guard_picture_sizes(GstElement* whole);

} // namespace godwit::io::video
