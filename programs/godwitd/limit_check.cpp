#include "programs/godwitd/limit_check.hpp"

#include <sys/resource.h>

namespace godwit::daemon {

process_limits limits_now() {
  rlimit space{RLIM_INFINITY, RLIM_INFINITY};
  rlimit files{RLIM_INFINITY, RLIM_INFINITY};
  (void)::getrlimit(RLIMIT_AS, &space);
  (void)::getrlimit(RLIMIT_NOFILE, &files);
  return {space.rlim_cur, files.rlim_cur};
}

std::optional<std::string> objection_to_limits(const process_limits& now) {
  if (now.address_space < least_address_space)
    return "the limit of address space is " + std::to_string(now.address_space) + " bytes, and godwitd needs " +
           std::to_string(least_address_space) + ": raise it (ulimit -v), or bound the memory itself (MemoryMax)";
  if (now.descriptors < least_descriptors)
    return "the limit of open files is " + std::to_string(now.descriptors) + ", and godwitd needs " +
           std::to_string(least_descriptors) + ": raise it (ulimit -n, LimitNOFILE)";
  return std::nullopt;
}

} // namespace godwit::daemon
