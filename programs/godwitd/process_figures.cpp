#include "programs/godwitd/process_figures.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include <sys/resource.h>
#include <unistd.h>

namespace godwit::daemon {
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
