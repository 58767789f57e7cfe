// Makes JPEGs of what the camera shows: for operators while somebody looks, and for the recording.
//
// A thread of its own, one picture at a time: what comes meanwhile takes the place of what waits, so a slow disk or a
// large picture costs pictures and never time of the detector. Errors: in the report. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "io/eyes/messages.hpp"
#include "io/eyes/picture_slot.hpp"
#include "io/video/frame.hpp"
#include "io/video/jpeg_encoder.hpp"
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

// Small pictures of what moves, for people who decide about it: each candidate with as much again around it, as JPEG.
//
// Of each track one a second, of a picture `most_a_picture`: what is left out has its turn with the next one. Larger
// ones are reduced. Errors: one that can not be made is left out. Thread: one at a time.
class cutout_maker {
public:
  static constexpr int quality = 75;
  static constexpr int most_side_px = 192;
  static constexpr int least_side_px = 48; // of what is cut out: a thing alone says little
  static constexpr int most_a_picture = 4;
  static constexpr std::int64_t gap_ns = 1'000'000'000;

  explicit cutout_maker(io::eyes::picture_slot& slot) : slot_(slot), encoder_(quality) {}

  void add(const io::eyes::candidates& seen, const io::video::frame& in);

private:
  struct made {
    std::uint32_t track = 0;
    std::int64_t at_ns = 0; // 0: none yet
  };
  [[nodiscard]] bool is_due(std::uint32_t track, std::int64_t now_ns) const;
  void make(const io::eyes::candidate& of, const io::video::frame& in);

  io::eyes::picture_slot& slot_;
  io::video::jpeg_encoder encoder_;
  std::array<made, io::eyes::max_cutouts> made_; // as they lie in the slot
};

} // namespace godwit::eyes
