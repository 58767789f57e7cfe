#include "io/sqlite/file_watch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <sys/stat.h>

namespace godwit::io::sqlite {
namespace {

std::string cut(const std::string& what, std::int64_t from, std::int64_t to) {
  return what + " was cut from " + std::to_string(from) + " to " + std::to_string(to) + " bytes";
}

} // namespace

file_watch::file_watch(std::string path, int descriptor)
    : path_(std::move(path)),
      descriptor_(descriptor), beside_{
                                   {{"-wal", "its log", longest_kept_log_bytes, {}},
                                    {"-shm", "the index of its log", std::numeric_limits<std::int64_t>::max(), {}}}} {}

std::optional<file_watch::identity> file_watch::identity_of(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    return std::nullopt;
  return identity{info.st_dev, info.st_ino, info.st_size};
}

std::optional<file_trouble> file_watch::look() {
  if (auto trouble = look_at_database())
    return trouble;
  for (auto& each : beside_)
    if (auto trouble = look_at(each))
      return trouble;
  return std::nullopt;
}

std::optional<file_trouble> file_watch::look_at_database() {
  struct stat ours {};
  if (::fstat(descriptor_, &ours) != 0)
    return file_trouble{false, "the file can not be read"};
  if (ours.st_size < bytes_)
    return file_trouble{false, cut("the file", bytes_, ours.st_size)};
  bytes_ = ours.st_size;
  const auto there = identity_of(path_);
  if (!there)
    return file_trouble{true, "the file was deleted or moved away"};
  if (there->device != ours.st_dev || there->number != ours.st_ino)
    return file_trouble{true, "another file lies in its place"};
  return std::nullopt;
}

std::optional<file_trouble> file_watch::look_at(part& each) const {
  const auto there = identity_of(path_ + each.suffix);
  const auto before = std::exchange(each.known, there ? there : each.known);
  if (!before)
    return std::nullopt;
  const std::string name = each.name;
  if (!there)
    return file_trouble{false, name + " was deleted or moved away"};
  if (there->device != before->device || there->number != before->number)
    return file_trouble{false, "another file lies in the place of " + name};
  if (there->bytes < std::min(before->bytes, each.may_shrink_from))
    return file_trouble{false, cut(name, before->bytes, there->bytes)};
  return std::nullopt;
}

} // namespace godwit::io::sqlite
