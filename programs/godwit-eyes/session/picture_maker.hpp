// Makes JPEGs of what the camera shows: for operators while somebody looks, and for the recording.
//
// A thread of its own, one picture at a time: what comes meanwhile takes the place of what waits, so a slow disk or a
// large picture costs pictures and never time of the detector. Errors: in the report. Thread: any.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "io/eyes/picture_slot.hpp"
#include "io/video/frame.hpp"
#include "io/video/recorder.hpp"

namespace godwit::eyes {

struct picture_report {
  std::uint64_t shown = 0; // put into the slot
  std::uint64_t recorded_bytes = 0;
  std::string record_error;
};

class picture_maker {
public:
  static constexpr int quality = 60;
  static constexpr std::int64_t record_gap_ns = 95'000'000; // about ten pictures a second are recorded

  // SLOT outlives it; null: nobody looks. RECORDS: none: nothing is recorded.
  picture_maker(io::eyes::picture_slot* slot, std::optional<io::video::recorder_settings> records);
  ~picture_maker();
  picture_maker(const picture_maker&) = delete;
  picture_maker& operator=(const picture_maker&) = delete;

  void want(std::int64_t until_ns, std::int64_t gap_ns);
  void offer(const io::video::frame& picture);
  [[nodiscard]] picture_report report() const;

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::eyes
