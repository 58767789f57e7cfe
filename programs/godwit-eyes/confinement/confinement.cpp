#include "programs/godwit-eyes/confinement/confinement.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "io/link/descriptor.hpp"
#include "programs/godwit-eyes/confinement/call_filter.hpp"

namespace godwit::eyes {

namespace {

using io::video::camera_kind;
using io::video::camera_uri;
namespace fs = std::filesystem;

// GStreamer writes it anew when plugins have changed.
std::string folder_of_registry() {
  const auto from = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  if (const auto file = from("GST_REGISTRY"); !file.empty())
    return fs::path(file).parent_path().string();
  const auto cache = from("XDG_CACHE_HOME");
  return (cache.empty() ? from("HOME") + "/.cache" : cache) + "/gstreamer-1.0";
}

// GIO, below GStreamer, would ask the desktop for proxies, settings and networks, which is out of reach.
void need_no_desktop() {
  for (const auto& [name, value] : {std::pair("GSETTINGS_BACKEND", "memory"),
                                    {"GIO_USE_VFS", "local"},
                                    {"GIO_USE_PROXY_RESOLVER", "dummy"},
                                    {"GIO_USE_NETWORK_MONITOR", "base"}})
    ::setenv(name, value, 1);
}

open_paths paths_for(const camera_uri& from, const std::string& record_folder) {
  open_paths result;
  result.readable = {"/usr",
                     "/lib",
                     "/lib64",
                     "/bin",
                     "/etc/ssl",
                     "/etc/ld.so.cache",
                     "/etc/fonts",
                     "/etc/hosts",
                     "/etc/resolv.conf",
                     "/etc/nsswitch.conf",
                     "/etc/host.conf",
                     "/etc/gai.conf",
                     "/etc/localtime",
                     "/etc/services",
                     "/etc/protocols",
                     "/proc/self",
                     "/proc/cpuinfo",
                     "/proc/meminfo",
                     "/proc/sys/vm",
                     "/sys",
                     "/run/udev",
                     "/dev/urandom",
                     "/dev/zero"};
  result.devices = {"/dev/null", "/dev/dri"};
  if (from.kind == camera_kind::device)
    result.devices.push_back(from.where);
  if (from.kind == camera_kind::file)
    result.readable.push_back(io::video::path_of(from));
  result.writable = {folder_of_registry()};
  if (!record_folder.empty())
    result.writable.push_back(record_folder);
  return result;
}

} // namespace

tl::expected<void, std::string> confine(const camera_uri& from, const std::string& record_folder) {
  std::error_code ignored; // what can not be made is reported by who writes there
  if (!record_folder.empty())
    fs::create_directories(record_folder, ignored);
  fs::create_directories(folder_of_registry(), ignored);
  need_no_desktop();
  const auto files = allow_only(paths_for(from, record_folder));
  const auto calls = refuse_calls(from.kind == camera_kind::network);
  return files ? calls : files;
}

device_identity::device_identity(const camera_uri& from) {
  if (from.kind != camera_kind::device)
    return;
  path_ = from.where;
  was_there_ = look(device_, number_);
}

bool device_identity::look(dev_t& device, ino_t& number) const {
  struct stat what {};
  if (::stat(path_.c_str(), &what) != 0)
    return false;
  device = what.st_dev;
  number = what.st_ino;
  return true;
}

bool device_identity::is_replaced() const {
  dev_t device = 0;
  ino_t number = 0;
  return !path_.empty() && look(device, number) && (!was_there_ || device != device_ || number != number_);
}

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
