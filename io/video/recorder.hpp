// Keeps what the camera shows, as JPEGs in Matroska files of a minute each, within a bound on the disk.
//
// Matroska, because it can carry JPEG as it is (MPEG-TS can not) and is read from its beginning on: a file that was not
// finished, because the process was killed, is read up to its last cluster. JPEG, because each picture stands alone and
// costs 2 ms, where a video encoder would take a core. Files: godwit-eyes-YYYYMMDDTHHMMSSZ-NNNN.mkv; the oldest are
// deleted first. Errors: a sentence in the report; it tries again later, and nobody waits for a disk longer than for
// one write. Thread: one at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace godwit::io::video {

struct recorder_settings {
  std::string folder; // is made when it is not there
  std::uint64_t max_bytes = 0;
  std::chrono::seconds segment{60};
};

struct recorder_report {
  std::uint64_t bytes = 0;    // of all segments in the folder
  std::uint64_t segments = 0; // begun since the start
  std::uint64_t dropped = 0;  // pictures that the disk was too slow for
  std::string error;          // empty: all is well
};

class recorder {
public:
  explicit recorder(recorder_settings wanted);
  ~recorder(); // finishes the segment
  recorder(const recorder&) = delete;
  recorder& operator=(const recorder&) = delete;

  void add(std::span<const std::byte> jpeg, std::int64_t captured_ns, std::int32_t width, std::int32_t height);
  [[nodiscard]] const recorder_report& report() const;

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::io::video
