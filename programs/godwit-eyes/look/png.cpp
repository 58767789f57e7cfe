#include "programs/godwit-eyes/look/png.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include <zlib.h>

#include "runtime/assert.hpp"

namespace godwit::eyes {

namespace {

constexpr int quick = 3; // of zlib's levels: a third of the time of its default, and a tenth larger

void append_number(std::string& to, std::uint32_t number) {
  for (unsigned shift = 32; shift > 0; shift -= 8)
    to += static_cast<char>((number >> (shift - 8)) & 0xFFU);
}

// Its checksum is over the type and the data.
void append_chunk(std::string& to, std::string_view type, std::string_view data) {
  append_number(to, static_cast<std::uint32_t>(data.size()));
  const auto begin = to.size();
  to += type;
  to += data;
  const auto* const bytes = reinterpret_cast<const Bytef*>(to.data() + begin); // zlib's bytes
  append_number(to, static_cast<std::uint32_t>(::crc32(0, bytes, static_cast<uInt>(to.size() - begin))));
}

std::string compressed(const std::string& bytes) {
  auto size = ::compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  const auto done = ::compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), quick);
  GODWIT_ASSERT(done == Z_OK, "there is room for what is compressed");
  result.resize(size);
  return result;
}

} // namespace

std::string png_of(const cv::Mat& picture) {
  GODWIT_ASSERT(picture.type() == CV_8UC3 && picture.rows > 0 && picture.cols > 0, "a picture of three bytes a pixel");
  std::string head;
  append_number(head, static_cast<std::uint32_t>(picture.cols));
  append_number(head, static_cast<std::uint32_t>(picture.rows));
  head += std::string_view("\x08\x02\x00\x00\x00", 5); // eight bits, true colour; neither filters nor rows interlaced
  std::string rows;
  const auto row_bytes = static_cast<std::size_t>(picture.cols) * 3;
  rows.reserve((row_bytes + 1) * static_cast<std::size_t>(picture.rows));
  for (int y = 0; y < picture.rows; ++y) {
    rows += '\0'; // the row is not filtered
    rows.append(reinterpret_cast<const char*>(picture.ptr(y)), row_bytes);
  }
  std::string result("\x89PNG\r\n\x1A\n", 8);
  append_chunk(result, "IHDR", head);
  append_chunk(result, "IDAT", compressed(rows));
  append_chunk(result, "IEND", {});
  return result;
}

tl::expected<void, std::string> write_png(const std::string& path, const cv::Mat& picture) {
  const auto bytes = png_of(picture);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    return tl::make_unexpected(path + " can not be written: " + std::strerror(errno));
  return {};
}

} // namespace godwit::eyes
