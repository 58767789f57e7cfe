#include "programs/godwitd/host_facts.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace godwit::daemon {

std::optional<std::uint64_t> host_facts::free_bytes() {
  const std::lock_guard guard(mutex_);
  read_if_old();
  return free_bytes_;
}

bool host_facts::is_program_exchanged() {
  const std::lock_guard guard(mutex_);
  read_if_old();
  return is_program_exchanged_;
}

void host_facts::read_if_old() {
  constexpr auto period_ns = std::chrono::nanoseconds(period).count();
  const auto now_ns = time_.monotonic_ns();
  if (read_ns_ && now_ns - *read_ns_ < period_ns)
    return;
  read_ns_ = now_ns;
  free_bytes_ = read_free_bytes_();
  is_program_exchanged_ = read_program_();
}

std::optional<std::uint64_t> free_bytes_beside(const std::string& file) {
  std::error_code failed;
  const auto folder = std::filesystem::absolute(file, failed).parent_path();
  const auto space = std::filesystem::space(folder, failed);
  return failed ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

bool is_without_name(const std::string& link) {
  struct stat info {};
  return ::stat(link.c_str(), &info) == 0 && info.st_nlink == 0;
}

namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

std::uint64_t count_entries(const char* folder) {
  std::error_code failed;
  std::uint64_t result = 0;
  for (std::filesystem::directory_iterator each(folder, failed), end; !failed && each != end; each.increment(failed))
    ++result;
  return result;
}

} // namespace

health::process_figures look_at_process(std::int64_t began_ms) {
  health::process_figures result;
  result.version = GODWIT_VERSION;
  result.began_ms = began_ms;
  rusage used{};
  if (::getrusage(RUSAGE_SELF, &used) == 0)
    result.cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  std::ifstream memory("/proc/self/statm");
  std::uint64_t pages = 0;
  std::uint64_t resident_pages = 0;
  if (memory >> pages >> resident_pages) {
    const auto page_bytes = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    result.virtual_bytes = pages * page_bytes;
    result.resident_bytes = resident_pages * page_bytes;
  }
  result.threads = count_entries("/proc/self/task");
  result.open_files = count_entries("/proc/self/fd");
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0)
    result.max_files = files.rlim_cur;
  return result;
}

} // namespace godwit::daemon
