#include "programs/godwit-eyes/confinement/confinement.hpp"

#include <cstdlib>
#include <filesystem>
#include <utility>

#include <sys/stat.h>

#include "programs/godwit-eyes/confinement/call_filter.hpp"
#include "programs/godwit-eyes/confinement/file_rules.hpp"

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

} // namespace godwit::eyes
