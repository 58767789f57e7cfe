// A picture as a PNG file: true colour, eight bits a channel. Errors: a sentence. Thread: any.
// Source: W3C, Portable Network Graphics (Second Edition).
#pragma once

#include <string>

#include <opencv2/core.hpp>
#include <tl/expected.hpp>

namespace godwit::eyes {

// Three bytes a pixel, red first (CV_8UC3).
[[nodiscard]] std::string png_of(const cv::Mat& picture);

[[nodiscard]] tl::expected<void, std::string> write_png(const std::string& path, const cv::Mat& picture);

} // namespace godwit::eyes
