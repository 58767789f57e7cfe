#include "programs/godwitd/doctor/host_findings.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <sys/stat.h>
#include <sys/timex.h>
#include <unistd.h>

#include "actors/executor/preflight/settings.hpp"

namespace godwit::daemon::doctor {
namespace {

constexpr std::array<std::uint32_t, 11> usual_bauds{38'400,  57'600,    115'200,   230'400,   460'800,  500'000,
                                                    921'600, 1'000'000, 1'500'000, 2'000'000, 3'000'000};
constexpr std::array<std::string_view, 5> port_names{"ttyACM", "ttyUSB", "ttyAMA", "ttyTHS", "ttyS"};
constexpr std::uint64_t bytes_per_mib = 1024 * 1024;

std::string listed(const std::vector<std::string>& ports) {
  std::string result;
  for (const auto& each : ports)
    result += (result.empty() ? "" : ", ") + each;
  return result;
}

std::string which_port(const std::vector<std::string>& ports) {
  return ports.empty() ? "No serial port is here: plug the autopilot in, or enable the UART of this computer."
                       : "Serial ports here: " + listed(ports) +
                             ". A name below /dev/serial/by-id stays the same when it is plugged in again.";
}

std::string join_group(const std::string& device, const std::string& group) {
  return "Add this user to the group of " + device + " (sudo usermod -aG " + group + " $USER), and log in again.";
}

} // namespace

// -- what the system says -----------------------------------------------------------------------------

device_state state_of(const std::string& device) {
  struct stat found {};
  if (::stat(device.c_str(), &found) != 0)
    return {};
  return {true, S_ISCHR(found.st_mode), ::access(device.c_str(), R_OK | W_OK) == 0};
}

std::vector<std::string> serial_ports() {
  std::vector<std::string> result;
  std::error_code no_folder;
  for (const auto& each : std::filesystem::directory_iterator("/dev", no_folder)) {
    const auto name = each.path().filename().string();
    const bool is_port = std::ranges::any_of(port_names, [&](auto begin) {
      return name.size() > begin.size() && name.starts_with(begin) && name[begin.size()] >= '0' &&
             name[begin.size()] <= '9';
    });
    if (is_port)
      result.push_back(each.path().string());
  }
  std::ranges::sort(result);
  return result;
}

std::optional<bool> is_clock_synchronised() {
  struct timex asked {};
  const auto state = ::adjtimex(&asked);
  return state < 0 ? std::nullopt : std::optional(state != TIME_ERROR && (asked.status & STA_UNSYNC) == 0);
}

// -- what is found --------------------------------------------------------------------------------------

finding judge_serial(const io::link::uri& line, const device_state& device, const std::vector<std::string>& ports) {
  constexpr const char* subject = "serial line";
  if (!device.exists)
    return {grade::problem, subject, "There is no " + line.device + ".", which_port(ports)};
  if (!device.is_character_device)
    return {grade::problem, subject, line.device + " is no serial port.", which_port(ports)};
  if (!device.may_use)
    return {grade::problem, subject, "This user may not use " + line.device + ".", join_group(line.device, "dialout")};
  if (std::ranges::find(usual_bauds, line.baud) == usual_bauds.end())
    return {grade::warning, subject, std::to_string(line.baud) + " is no usual baud rate.",
            "Set the rate of the autopilot's port: 57600 for radios, 115200 to 921600 for a cable."};
  return {grade::good, subject, line.device + " can be opened, at " + std::to_string(line.baud) + " baud."};
}

finding judge_missing_line(const std::vector<std::string>& ports) {
  return {grade::problem, "line", "No line to an autopilot is set (vehicle.uri).",
          "Use --vehicle serial:///dev/NAME:BAUD or --vehicle udpin://0.0.0.0:14550. " + which_port(ports)};
}

finding judge_camera(const std::string& uri, const device_state& device) {
  constexpr const char* subject = "camera";
  constexpr std::string_view scheme = "v4l2://";
  const auto file = uri.substr(std::min(scheme.size(), uri.size()));
  if (!device.exists)
    return {grade::problem, subject, "There is no " + file + ".",
            "Plug the camera in, or name another one in camera.uri."};
  if (!device.may_use)
    return {grade::problem, subject, "This user may not use " + file + ".", join_group(file, "video")};
  return {grade::good, subject, file + " can be opened; `godwit-eyes probe " + uri + "` shows its pictures' form."};
}

finding judge_clock(std::optional<bool> is_synchronised) {
  if (!is_synchronised)
    return {grade::warning, "clock", "Whether the clock is synchronised is not known.",
            "Look at `timedatectl`; times in reports come from this clock."};
  if (!*is_synchronised)
    return {grade::warning, "clock", "The clock is not synchronised: times in reports may be wrong.",
            "Enable systemd-timesyncd or chrony, or give chrony the time of a GNSS receiver."};
  return {grade::good, "clock", "The clock is synchronised."};
}

finding judge_disk(const std::string& folder, std::optional<std::uint64_t> free_bytes) {
  const executor::preflight::settings limits;
  if (!free_bytes)
    return {grade::warning, "disk", "How much room " + folder + " has is not known.", "Check that the folder exists."};
  const auto mib = *free_bytes / bytes_per_mib;
  const auto room = folder + " has " + std::to_string(mib) + " MiB free";
  if (mib < static_cast<std::uint64_t>(limits.journal_min_free_mib))
    return {grade::problem, "disk",
            room + ": no flight starts below " + std::to_string(limits.journal_min_free_mib) + ".",
            "Remove old traces, or move --journal and --trace to another disk."};
  if (mib < static_cast<std::uint64_t>(limits.journal_low_free_mib))
    return {grade::warning, "disk", room + ", less than " + std::to_string(limits.journal_low_free_mib) + ".",
            "Remove old traces, or move --journal and --trace to another disk."};
  return {grade::good, "disk", room + "."};
}

} // namespace godwit::daemon::doctor
