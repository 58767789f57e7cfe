// The files of a simulated autopilot, as ground stations read them by MAVLink FTP (FILE_TRANSFER_PROTOCOL).
//
//   OpenFileRO ──> session ──ReadFile, BurstReadFile──> data, NAK EndOfFile after the last ──TerminateSession──>
//
// An ArduPilot has its parameters in one file, @PARAM/param.pck, which QGroundControl and MAVProxy ask for before they
// ask for parameters one by one. Other files are not found, and what writes is refused. One session at a time. A
// request that is lost or cut off is not answered. Pure. Thread: one at a time. Source: MAVLink, "File Transfer
// Protocol (FTP)"; ArduPilot's GCS_FTP.cpp and AP_Filesystem_Param.cpp (4.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "io/mavlink/frame.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

inline constexpr std::uint32_t file_transfer_id = 110;
inline constexpr std::uint8_t file_transfer_crc_extra = 84;

class file_server {
public:
  struct file {
    std::string path;
    std::vector<std::byte> content;
    std::uint32_t size_told = 0; // when it is opened
  };
  using payload = std::vector<std::byte>;

  // FROM: the station; PAYLOAD of its message; FILES as they are now. Answers in order, each the payload of a message.
  [[nodiscard]] std::vector<payload> on(mavlink::sender from, mavlink::byte_view asked, const std::vector<file>& files);

private:
  struct request;
  struct reply;
  [[nodiscard]] reply open(const request& asked, const std::vector<file>& files);
  [[nodiscard]] reply read(const request& asked, std::size_t offset) const;

  bool is_open_ = false;
  std::uint8_t session_ = 0;
  std::vector<std::byte> content_;
};

// All parameters in ArduPilot's packed form.
[[nodiscard]] file_server::file param_file(const std::vector<role::param>& params);

} // namespace godwit::sim
