#include "programs/godwit-eyes/confinement/file_rules.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "io/link/descriptor.hpp"

namespace godwit::eyes {
namespace {

// Of newer kernels than the headers of Debian 12.
constexpr std::uint64_t truncate_right = 1U << 14U;       // ABI 3
constexpr std::uint64_t ask_device_right = 1U << 15U;     // ABI 5
constexpr std::uint64_t bind_right = 1U << 0U;            // ABI 4, of the network
constexpr std::uint64_t abstract_socket_scope = 1U << 0U; // ABI 6
constexpr std::uint64_t signal_scope = 1U << 1U;          // the same

struct ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
  std::uint64_t scoped = 0;
};

constexpr std::uint64_t file_rights = LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                      LANDLOCK_ACCESS_FS_READ_FILE | truncate_right | ask_device_right;
constexpr std::uint64_t read_rights =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t write_rights = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR |
                                       LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                                       LANDLOCK_ACCESS_FS_MAKE_REG | truncate_right;
constexpr std::uint64_t device_rights =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR | LANDLOCK_ACCESS_FS_WRITE_FILE | ask_device_right;
// All that each kernel can refuse.
constexpr std::uint64_t rights_of_abi_1 = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1;

std::string why(const std::string& what) { return what + ": " + std::strerror(errno); }

long landlock_abi() { return ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION); }

ruleset handled_by(long abi) {
  ruleset result{rights_of_abi_1};
  if (abi >= 2)
    result.files |= LANDLOCK_ACCESS_FS_REFER;
  if (abi >= 3)
    result.files |= truncate_right;
  if (abi >= 4)
    result.network = bind_right;
  if (abi >= 5)
    result.files |= ask_device_right;
  if (abi >= 6)
    result.scoped = abstract_socket_scope | signal_scope;
  return result;
}

std::size_t size_for(long abi) { return sizeof(std::uint64_t) * (abi >= 6 ? 3U : abi >= 4 ? 2U : 1U); }

// What is not there needs no rule.
void allow(int rules, const std::string& path, std::uint64_t rights) {
  const io::link::descriptor place(::open(path.c_str(), O_PATH | O_CLOEXEC));
  struct stat what {};
  if (place.number() < 0 || ::fstat(place.number(), &what) != 0)
    return;
  if (!S_ISDIR(what.st_mode))
    rights &= file_rights;
  landlock_path_beneath_attr rule{rights, place.number()};
  static_cast<void>(::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0));
}

} // namespace

tl::expected<void, std::string> allow_only(const open_paths& paths) {
  const auto abi = landlock_abi();
  if (abi < 1)
    return tl::make_unexpected(why("this kernel has no Landlock (Linux 5.13)"));
  const auto handled = handled_by(abi);
  const io::link::descriptor rules(
      static_cast<int>(::syscall(SYS_landlock_create_ruleset, &handled, size_for(abi), 0)));
  if (rules.number() < 0)
    return tl::make_unexpected(why("Landlock makes no rules"));
  for (const auto& each : paths.readable)
    allow(rules.number(), each, read_rights & handled.files);
  for (const auto& each : paths.writable)
    allow(rules.number(), each, write_rights & handled.files);
  for (const auto& each : paths.devices)
    allow(rules.number(), each, device_rights & handled.files);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || ::syscall(SYS_landlock_restrict_self, rules.number(), 0) != 0)
    return tl::make_unexpected(why("Landlock does not take its rules"));
  return {};
}

} // namespace godwit::eyes
