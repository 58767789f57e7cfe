#include "programs/godwit-eyes/confinement/call_filter.hpp"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace godwit::eyes {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t own_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t own_architecture = AUDIT_ARCH_AARCH64;
#else
#error "the call filter knows this architecture not"
#endif

constexpr std::uint32_t x32_bit = 0x40000000; // a second table of calls on x86-64
constexpr int chmod_by_flags = 452;           // fchmodat2, newer than the headers of Debian 12

// Into other processes, or past Landlock, which does not look at modes, owners and attributes.
constexpr std::array refused {
  SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_pidfd_open, SYS_pidfd_getfd, SYS_pidfd_send_signal,
      SYS_tkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, SYS_setpriority, SYS_io_uring_setup, SYS_bpf,
      SYS_perf_event_open, SYS_userfaultfd, SYS_keyctl, SYS_fchmodat, SYS_fchownat, SYS_truncate, SYS_setxattr,
      SYS_lsetxattr, SYS_removexattr, SYS_lremovexattr, SYS_kcmp, SYS_process_madvise,
#if defined(__x86_64__)
      SYS_chmod, SYS_chown, SYS_lchown,
#endif
      chmod_by_flags
};

// About the process whose number is their first argument: only about ourselves.
constexpr std::array about_a_process{
    SYS_kill,           SYS_tgkill,       SYS_prlimit64, SYS_sched_setaffinity, SYS_sched_setscheduler,
    SYS_sched_setparam, SYS_sched_setattr};

constexpr auto argument_at = static_cast<std::uint32_t>(offsetof(seccomp_data, args));
constexpr auto second_argument_at = argument_at + sizeof(std::uint64_t);
constexpr std::uint32_t kind_of_socket = 0xF; // without its flags
constexpr std::uint32_t allowed = SECCOMP_RET_ALLOW;
constexpr std::uint32_t no_permission = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t no_access = SECCOMP_RET_ERRNO | EACCES;

class program {
public:
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
  void end(std::uint32_t with) { add(BPF_RET | BPF_K, with); }
  // The next COUNT steps only where what was loaded is VALUE.
  void only_if(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, count); }
  void not_if(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JEQ | BPF_K, value, count, 0); }
  void only_if_at_least(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JGE | BPF_K, value, 0, count); }

  void mask(std::uint32_t bits) { add(BPF_ALU | BPF_AND | BPF_K, bits); }

  [[nodiscard]] std::vector<sock_filter>& steps() { return steps_; }

private:
  void add(unsigned code, std::uint32_t value, std::uint8_t is_so = 0, std::uint8_t else_skip = 0) {
    steps_.push_back({static_cast<std::uint16_t>(code), is_so, else_skip, value});
  }
  std::vector<sock_filter> steps_;
};

program filter_for(bool uses_network) {
  program result;
  result.load(offsetof(seccomp_data, arch));
  result.not_if(own_architecture, 1);
  result.end(no_permission);
  result.load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
  result.only_if_at_least(x32_bit, 1);
  result.end(no_permission);
#endif
  for (const auto call : refused) {
    result.only_if(static_cast<std::uint32_t>(call), 1);
    result.end(no_permission);
  }
  const auto self = static_cast<std::uint32_t>(::getpid());
  for (const auto call : about_a_process) {
    result.only_if(static_cast<std::uint32_t>(call), 5);
    result.load(argument_at); // its lower half: a process has 32 bits
    result.not_if(self, 2);
    result.not_if(call == SYS_kill ? self : 0, 1); // 0 of kill: the daemon's whole group
    result.end(no_permission);
    result.end(allowed);
  }
  result.only_if(SYS_socket, 6);
  result.load(argument_at);
  result.not_if(AF_NETLINK, 3); // which devices and addresses there are
  result.not_if(uses_network ? AF_INET : AF_NETLINK, 2);
  result.not_if(uses_network ? AF_INET6 : AF_NETLINK, 1);
  result.end(no_access);
  result.end(allowed);
  // GStreamer wakes its threads by a pair of streams, which stays one. One of datagrams could be turned to somebody
  // else.
  result.only_if(SYS_socketpair, 4);
  result.load(second_argument_at);
  result.mask(kind_of_socket);
  result.not_if(SOCK_STREAM, 1);
  result.end(no_access);
  result.end(allowed);
  return result;
}

} // namespace

tl::expected<void, std::string> refuse_calls(bool uses_network) {
  auto steps = filter_for(uses_network).steps();
  const sock_fprog filter{static_cast<std::uint16_t>(steps.size()), steps.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0)
    return tl::make_unexpected(std::string("this kernel filters no calls (seccomp): ") + std::strerror(errno));
  return {};
}

} // namespace godwit::eyes
