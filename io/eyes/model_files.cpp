#include "io/eyes/model_files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

namespace godwit::io::eyes {

namespace {

namespace fs = std::filesystem;

tl::expected<std::string, std::string> bytes_of(const fs::path& path) {
  std::error_code failed;
  const auto size = fs::file_size(path, failed);
  if (failed)
    return tl::make_unexpected(path.string() + " can not be read: " + failed.message());
  if (size == 0 || size > max_model_bytes)
    return tl::make_unexpected(path.string() + " has " + std::to_string(size) + " bytes; a model has 1 to " +
                               std::to_string(max_model_bytes));
  std::string result(size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(result.data(), static_cast<std::streamsize>(size)))
    return tl::make_unexpected(path.string() + " can not be read: " + std::strerror(errno));
  return result;
}

} // namespace

tl::expected<model_files, std::string> read_model(const std::string& path) {
  const fs::path weights(path);
  const auto ending = weights.extension();
  if (ending != ".onnx" && ending != ".weights")
    return tl::make_unexpected(path + " is no model: it ends in .onnx, or in .weights with its .cfg beside it");
  model_files result;
  if (ending == ".weights") {
    auto layers = bytes_of(fs::path(weights).replace_extension(".cfg"));
    if (!layers)
      return tl::make_unexpected(std::move(layers.error()));
    result.layers = *std::move(layers);
  }
  auto bytes = bytes_of(weights);
  if (!bytes)
    return tl::make_unexpected(std::move(bytes.error()));
  result.weights = *std::move(bytes);
  return result;
}

} // namespace godwit::io::eyes
