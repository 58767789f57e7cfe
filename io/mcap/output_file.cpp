#include "io/mcap/output_file.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace godwit::io::mcap {

result<void> output_file::open(const std::filesystem::path& path, int flags) {
  static_cast<void>(close());
  name_ = path.string();
  size_bytes_ = 0;
  descriptor_ = ::open(name_.c_str(), flags | O_CLOEXEC, 0600); // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (descriptor_ < 0) {
    return tl::make_unexpected(system_error(name_, "open", errno));
  }
  return {};
}

result<void> output_file::create(const std::filesystem::path& path) {
  std::error_code ignored;
  const bool device = std::filesystem::is_character_file(path, ignored);
  return open(path, device ? O_WRONLY : O_WRONLY | O_CREAT | O_EXCL);
}

result<void> output_file::open_and_cut(const std::filesystem::path& path, std::uint64_t keep_bytes) {
  return open(path, O_WRONLY | O_NOFOLLOW).and_then([&] { return cut(keep_bytes); });
}

result<void> output_file::cut(std::uint64_t keep_bytes) {
  const auto length = static_cast<off_t>(keep_bytes);
  if (::ftruncate(descriptor_, length) != 0 || ::lseek(descriptor_, length, SEEK_SET) != length) {
    return tl::make_unexpected(system_error(name_, "truncate", errno));
  }
  size_bytes_ = keep_bytes;
  return {};
}

result<void> output_file::append(byte_view bytes) {
  if (!is_open()) {
    return tl::make_unexpected(error{errc::not_open, name_, "append to a closed file", 0});
  }
  const std::uint64_t size_before_bytes = size_bytes_;
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      // A write of nothing is not an error for POSIX, but would be an endless loop for us.
      const error failure = system_error(name_, "write", written < 0 ? errno : EIO);
      static_cast<void>(cut(size_before_bytes));
      return tl::make_unexpected(failure);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    size_bytes_ += static_cast<std::uint64_t>(written);
  }
  return {};
}

bool output_file::is_in_place() const {
  struct stat named {};
  struct stat opened {};
  return ::fstat(descriptor_, &opened) == 0 && ::stat(name_.c_str(), &named) == 0 && named.st_ino == opened.st_ino &&
         named.st_dev == opened.st_dev;
}

result<void> output_file::close() {
  if (!is_open()) {
    return {};
  }
  const int status = ::close(descriptor_);
  descriptor_ = -1; // also after an error: the descriptor is gone then, too
  if (status != 0) {
    return tl::make_unexpected(system_error(name_, "close", errno));
  }
  return {};
}

} // namespace godwit::io::mcap
