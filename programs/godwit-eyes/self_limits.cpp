#include "programs/godwit-eyes/self_limits.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace godwit::eyes {
namespace {

// The kernel ends whoever has the most, counted so, first.
bool is_first_to_go() {
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0)
    return false;
  const bool is_written = ::write(file, "1000", 4) == 4;
  ::close(file);
  return is_written;
}

bool is_bounded() {
#ifdef __SANITIZE_ADDRESS__
  return true; // its shadow alone is more
#else
  const rlimit bound{max_memory_bytes, max_memory_bytes};
  return ::setrlimit(RLIMIT_DATA, &bound) == 0;
#endif
}

} // namespace

const char* limit_own_memory() {
  if (!is_bounded())
    return "its memory can not be bounded; a broken video may take all of it";
  if (!is_first_to_go())
    return "the kernel does not end it first when memory runs out (/proc/self/oom_score_adj)";
  return nullptr;
}

} // namespace godwit::eyes
