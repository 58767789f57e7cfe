// The files of a net that finds COCO's classes: of Darknet, NAME.weights with NAME.cfg beside it; or NAME.onnx.
//
// Only read: what is in them is for OpenCV to understand, in the confined helper. Errors: a sentence without a full
// stop, with the name of the file. Thread: any; blocks on the disk.
#pragma once

#include <cstddef>
#include <string>

#include <tl/expected.hpp>

namespace godwit::io::eyes {

inline constexpr std::size_t max_model_bytes = std::size_t{64} * 1024 * 1024; // of each file

struct model_files {
  std::string layers; // the .cfg; empty: of an .onnx
  std::string weights;
};

[[nodiscard]] tl::expected<model_files, std::string> read_model(const std::string& path);

} // namespace godwit::io::eyes
