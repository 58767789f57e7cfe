#include "io/sqlite/bus_guard.hpp"

#include <atomic>
#include <csignal>
#include <mutex>

#include <sys/mman.h>
#include <unistd.h>

namespace godwit::io::sqlite {
namespace {

std::atomic<std::uint64_t> errors{0};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "a signal handler counts with it");
std::uintptr_t page_bytes = 4096;

// Only a system call and a counter: what a handler may use.
void on_bus_error(int, siginfo_t* what, void*) {
  const auto page = reinterpret_cast<std::uintptr_t>(what->si_addr) & ~(page_bytes - 1);
  auto* const there = reinterpret_cast<void*>(page); // NOLINT(performance-no-int-to-ptr): that is what an address is
  const bool is_gone = what->si_code == BUS_ADRERR && page != 0;
  if (is_gone &&
      ::mmap(there, page_bytes, PROT_READ | PROT_WRITE, MAP_FIXED | MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED) {
    errors.fetch_add(1);
    return;
  }
  std::signal(SIGBUS, SIG_DFL); // the same instruction comes again, or the same signal, and ends the process
  if (what->si_code <= 0)       // sent by somebody
    std::raise(SIGBUS);
}

} // namespace

void guard_against_bus_errors() {
  static std::once_flag once;
  std::call_once(once, [] {
    page_bytes = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    struct sigaction wanted {};
    wanted.sa_sigaction = &on_bus_error;
    wanted.sa_flags = SA_SIGINFO | SA_RESTART;
    ::sigemptyset(&wanted.sa_mask);
    ::sigaction(SIGBUS, &wanted, nullptr);
  });
}

std::uint64_t bus_errors() { return errors.load(); }

} // namespace godwit::io::sqlite
