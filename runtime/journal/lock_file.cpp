#include "runtime/journal/lock_file.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace godwit::runtime {

namespace {

std::string holder_of(int descriptor) {
  std::array<char, 32> text{};
  const auto size = ::pread(descriptor, text.data(), text.size() - 1, 0);
  std::string pid(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  while (!pid.empty() && pid.back() == '\n')
    pid.pop_back();
  return pid.empty() ? "of unknown id" : pid;
}

journal_error lock_error(const std::string& journal, int error_number) {
  const bool forbidden = error_number == EACCES || error_number == EROFS || error_number == EPERM;
  const bool full = error_number == ENOSPC || error_number == EDQUOT;
  return {full        ? journal_errc::disk_full
          : forbidden ? journal_errc::read_only
                      : journal_errc::io,
          journal, "the lock file " + journal + ".lock can not be made (" + std::strerror(error_number) + ")",
          full ? "Free space on its file system."
               : "Give this user the right to write in the folder, and mount the file system for writing."};
}

} // namespace

tl::expected<lock_file, journal_error> lock_file::acquire(const std::string& journal) {
  const int descriptor = ::open((journal + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0)
    return tl::unexpected(lock_error(journal, errno));
  lock_file held(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      return tl::unexpected(lock_error(journal, errno));
    const auto holder = holder_of(descriptor);
    return tl::unexpected(journal_error{journal_errc::locked, journal,
                                        "process " + holder + " writes this journal already",
                                        "End that process, or give this one another journal."});
  }
  // The id is for people; the lock holds without it, so a full disk here is no reason to stop.
  const auto pid = std::to_string(::getpid()) + "\n";
  if (::ftruncate(descriptor, 0) == 0)
    static_cast<void>(::pwrite(descriptor, pid.data(), pid.size(), 0) == 0);
  return held;
}

lock_file::lock_file(lock_file&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

lock_file& lock_file::operator=(lock_file&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

lock_file::~lock_file() { release(); }

void lock_file::release() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
  descriptor_ = -1;
}

} // namespace godwit::runtime
