#include "io/mcap/byte_source.hpp"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace godwit::io::mcap {

file_source::~file_source() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

result<void> file_source::open(const std::filesystem::path& path) {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
  name_ = path.string();
  descriptor_ = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC); // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (descriptor_ < 0) {
    return tl::make_unexpected(system_error(name_, "open", errno));
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) {
    return tl::make_unexpected(system_error(name_, "stat", errno));
  }
  size_bytes_ = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  return {};
}

result<std::size_t> file_source::read_at(std::uint64_t offset, std::span<std::byte> to) const {
  std::size_t total = 0;
  while (total < to.size()) {
    const ssize_t got = ::pread(descriptor_, to.data() + total, to.size() - total, static_cast<off_t>(offset + total));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      return tl::make_unexpected(system_error(name_, "read", errno));
    }
    if (got == 0) {
      break;
    }
    total += static_cast<std::size_t>(got);
  }
  return total;
}

result<std::size_t> memory_source::read_at(std::uint64_t offset, std::span<std::byte> to) const {
  if (offset >= bytes_.size()) {
    return std::size_t{0};
  }
  const byte_view rest = bytes_.subspan(static_cast<std::size_t>(offset));
  const std::size_t count = std::min(rest.size(), to.size());
  std::copy_n(rest.begin(), count, to.begin());
  return count;
}

} // namespace godwit::io::mcap
