// What this computer offers a flight: the serial line and the camera as devices, the clock, room on the disk. Thread:
// pure, but for the functions that read the system. Source: adjtimex(2), access(2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/link/uri.hpp"
#include "programs/godwitd/doctor/finding.hpp"

namespace godwit::daemon::doctor {

struct device_state {
  bool exists = false;
  bool is_character_device = false;
  bool may_use = false; // this user may read and write it
};

[[nodiscard]] device_state state_of(const std::string& device);
// Of autopilots and radios, as far as their names tell: /dev/ttyACM0, /dev/ttyUSB0, /dev/ttyAMA0, ...
[[nodiscard]] std::vector<std::string> serial_ports();
// Nothing: the system does not tell.
[[nodiscard]] std::optional<bool> is_clock_synchronised();

[[nodiscard]] finding judge_serial(const io::link::uri& line, const device_state& device,
                                   const std::vector<std::string>& ports);
// No line to an autopilot is configured.
[[nodiscard]] finding judge_missing_line(const std::vector<std::string>& ports);
// URI: v4l2:///dev/video0.
[[nodiscard]] finding judge_camera(const std::string& uri, const device_state& device);
[[nodiscard]] finding judge_clock(std::optional<bool> is_synchronised);
// FREE_BYTES on the disk of FOLDER.
[[nodiscard]] finding judge_disk(const std::string& folder, std::optional<std::uint64_t> free_bytes);

} // namespace godwit::daemon::doctor
