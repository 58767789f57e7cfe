#include "io/sqlite/lock_file.hpp"

#include <array>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace godwit::io::sqlite {

namespace {

std::string holder_of(int descriptor) {
  std::array<char, 32> text{};
  const auto size = ::pread(descriptor, text.data(), text.size() - 1, 0);
  std::string pid(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  while (!pid.empty() && pid.back() == '\n')
    pid.pop_back();
  return pid.empty() ? "of unknown id" : pid;
}

} // namespace

store_result<lock_file> lock_file::acquire(const store_kind& kind, const std::string& path) {
  const auto doing = "making the lock file " + path + ".lock";
  const int descriptor = ::open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0)
    return tl::unexpected(system_error(kind, path, errno, doing));
  lock_file held(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      return tl::unexpected(system_error(kind, path, errno, doing));
    return tl::unexpected(store_error{store_errc::locked, path,
                                      "process " + holder_of(descriptor) + " writes this " + kind.name + " already",
                                      "End that process, or give this one another " + kind.name});
  }
  // The id is for people; the lock holds without it, so a full disk here is no reason to stop.
  const auto pid = std::to_string(::getpid()) + "\n";
  if (::ftruncate(descriptor, 0) == 0)
    static_cast<void>(::pwrite(descriptor, pid.data(), pid.size(), 0) == 0);
  return held;
}

store_result<void> lock_file::hold(const store_kind& kind, const std::string& path) {
  database_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (database_ < 0)
    return tl::unexpected(system_error(kind, path, errno, "opening it"));
  struct stat info {};
  if (::fstat(database_, &info) != 0)
    return tl::unexpected(system_error(kind, path, errno, "looking at it"));
  if (info.st_nlink > 1)
    return tl::unexpected(store_error{store_errc::foreign, path,
                                      "the file has " + std::to_string(info.st_nlink) +
                                          " names (hard links), and each would have a log of its own",
                                      "Remove the other names, or make a copy for them"});
  if (::flock(database_, LOCK_EX | LOCK_NB) == 0)
    return {};
  if (errno != EWOULDBLOCK)
    return tl::unexpected(system_error(kind, path, errno, "locking it"));
  return tl::unexpected(store_error{store_errc::locked, path,
                                    "another process writes this " + kind.name + " already, under another name",
                                    "End that process, or give this one another " + kind.name});
}

lock_file::lock_file(lock_file&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), database_(std::exchange(other.database_, -1)) {}

lock_file& lock_file::operator=(lock_file&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(database_, other.database_);
  return *this;
}

lock_file::~lock_file() { release(); }

void lock_file::release() {
  for (auto* each : {&database_, &descriptor_}) {
    if (*each >= 0)
      ::close(*each);
    *each = -1;
  }
}

} // namespace godwit::io::sqlite
