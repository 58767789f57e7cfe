#include "io/video/jpeg_encoder.hpp"

#include <array>

#include <turbojpeg.h>

namespace godwit::io::video {

struct jpeg_encoder::parts {
  tjhandle handle = tjInitCompress();
  unsigned char* buffer = nullptr; // TurboJPEG makes it larger as it needs
  unsigned long size = 0;
  int quality = 0;
};

jpeg_encoder::jpeg_encoder(int quality) : parts_(std::make_unique<parts>()) { parts_->quality = quality; }

jpeg_encoder::~jpeg_encoder() {
  tjFree(parts_->buffer);
  if (parts_->handle != nullptr)
    tjDestroy(parts_->handle);
}

tl::expected<std::span<const std::byte>, std::string> jpeg_encoder::encode(const frame& picture) {
  if (parts_->handle == nullptr)
    return tl::make_unexpected(std::string("there is no memory for a JPEG encoder"));
  std::array<const unsigned char*, 3> planes{};
  std::array<int, 3> strides{};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes.at(i) = picture.planes.at(i).pixels;
    strides.at(i) = static_cast<int>(picture.planes.at(i).stride);
  }
  auto size = parts_->size;
  if (tjCompressFromYUVPlanes(parts_->handle, planes.data(), picture.width, strides.data(), picture.height, TJSAMP_420,
                              &parts_->buffer, &size, parts_->quality, TJFLAG_FASTDCT) != 0)
    return tl::make_unexpected("a picture can not be made a JPEG: " + std::string(tjGetErrorStr2(parts_->handle)));
  if (size > parts_->size)
    parts_->size = size;
  return std::as_bytes(std::span(parts_->buffer, size));
}

} // namespace godwit::io::video
