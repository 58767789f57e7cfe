#include "programs/godwit-eyes/look/boxes_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace godwit::eyes {

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
