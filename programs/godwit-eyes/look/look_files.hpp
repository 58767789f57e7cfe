// The files of `godwit-eyes look`: pictures read and written, boxes written.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>

#include <opencv2/core.hpp>
#include <tl/expected.hpp>

#include "io/video/source.hpp"
#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

// A picture as a PNG file: true colour, eight bits a channel. Errors: a sentence. Thread: any.
// Source: W3C, Portable Network Graphics (Second Edition).

// Three bytes a pixel, red first (CV_8UC3).
[[nodiscard]] std::string png_of(const cv::Mat& picture);

[[nodiscard]] tl::expected<void, std::string> write_png(const std::string& path, const cv::Mat& picture);

// The pictures of a recording one by one, or those of a camera as they come. Errors: a sentence. Thread: one.
class picture_reader {
public:
  explicit picture_reader(const io::video::camera_uri& from);

  // Waits for it. Nothing: it is over, or it failed.
  [[nodiscard]] std::optional<io::video::frame> next();
  // Why it failed; empty: it has not.
  [[nodiscard]] const std::string& problem() const { return problem_; }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_come_ = false;
  std::string problem_;
  io::video::source source_; // last: it calls from its beginning on
};

// What the detector found in each picture of a recording, as two tables of comma-separated values for whoever scores
// it: `frame,track,x,y,w,h,score` of all that was confirmed, in pixels of the picture, and `frame,usable` (1 or 0).
// Pictures count from 1. Nothing that is there is written over. Errors: a sentence. Thread: one.
class boxes_file {
public:
  // Without a name a table is not written.
  [[nodiscard]] tl::expected<void, std::string> open(const std::string& boxes, const std::string& use);
  void add(std::uint64_t picture, const verdict& seen);
  [[nodiscard]] tl::expected<void, std::string> close();

private:
  struct table {
    std::string path;
    std::ofstream file;
  };
  table boxes_;
  table use_;
};

} // namespace godwit::eyes
