#include "programs/godwit-eyes/look/look_files.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

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

namespace {

constexpr std::chrono::milliseconds look_period{50}; // shorter than a source rests between two tries

} // namespace

picture_reader::picture_reader(const io::video::camera_uri& from)
    : source_(
          from, {},
          [this] {
            {
              const std::lock_guard guard(mutex_);
              has_come_ = true;
            }
            changed_.notify_all();
          },
          from.kind != io::video::camera_kind::file) {}

std::optional<io::video::frame> picture_reader::next() {
  using io::video::source_state;
  for (;;) {
    const auto now = source_.report(); // first: what had come by then is taken below
    if (auto picture = source_.take())
      return picture;
    if (now.state == source_state::ended)
      return std::nullopt;
    if (now.state == source_state::failed || (now.state == source_state::opening && !now.reason.empty())) {
      problem_ = now.reason;
      return std::nullopt;
    }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, look_period, [this] { return has_come_; });
    has_come_ = false;
  }
}

tl::expected<void, std::string> boxes_file::open(const std::string& boxes, const std::string& use) {
  boxes_.path = boxes;
  use_.path = use;
  for (table* const each : {&boxes_, &use_}) {
    if (each->path.empty())
      continue;
    std::error_code failed;
    if (std::filesystem::exists(each->path, failed))
      return tl::make_unexpected(each->path + " is there already: name another file, or delete it");
    each->file.open(each->path);
    if (!each->file)
      return tl::make_unexpected(each->path + " can not be written: " + std::strerror(errno));
    each->file << (each == &boxes_ ? "frame,track,x,y,w,h,score\n" : "frame,usable\n");
  }
  return {};
}

void boxes_file::add(std::uint64_t picture, const verdict& seen) {
  const auto number = static_cast<unsigned long long>(picture);
  std::array<char, 160> row{};
  for (const auto& each : seen.confirmed) {
    std::snprintf(row.data(), row.size(), "%llu,%u,%.1f,%.1f,%.1f,%.1f,%.3f\n", number, each.track, each.box.x_px,
                  each.box.y_px, each.box.width_px, each.box.height_px, each.confidence);
    boxes_.file << row.data();
  }
  use_.file << number << ',' << (seen.why == unusable::none ? 1 : 0) << '\n';
}

tl::expected<void, std::string> boxes_file::close() {
  for (table* const each : {&boxes_, &use_}) {
    if (each->path.empty())
      continue;
    each->file.close();
    if (!each->file)
      return tl::make_unexpected(each->path + " can not be written: is the disk full?");
  }
  return {};
}

} // namespace godwit::eyes
