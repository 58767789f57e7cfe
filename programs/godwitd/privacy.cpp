#include "programs/godwitd/privacy.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace godwit::daemon {

void keep_memory_private() {
  const rlimit none{0, 0};
  (void)::setrlimit(RLIMIT_CORE, &none); // it can only be lowered, which no system refuses
#if !defined(__SANITIZE_ADDRESS__) &&                                                                                  \
    !defined(__SANITIZE_THREAD__) // those look at their own process as a debugger does
  (void)::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
#endif
  (void)::umask(S_IRWXG | S_IRWXO);
}

} // namespace godwit::daemon
