// What is said to and by movement_detector. Times are monotonic where nothing else stands. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/eyes/messages.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::movement_detector {

// From the port, as the helper process said it and after it was checked. RUN: of which start; one that is not the
// newest is old.
struct helper_status {
  std::uint32_t run = 0;
  io::eyes::status what;
  GODWIT_FIELDS(helper_status, "movement_detector.helper_status", run, what);
};

struct helper_candidates {
  std::uint32_t run = 0;
  io::eyes::candidates what;
  GODWIT_FIELDS(helper_candidates, "movement_detector.helper_candidates", run, what);
};

// It is gone: crashed, killed, said what is no message, or could not be started.
struct helper_ended {
  std::uint32_t run = 0;
  std::string why;
  GODWIT_FIELDS(helper_ended, "movement_detector.helper_ended", run, why);
};

// Answered from memory, at once.
struct get_eyes {
  static constexpr auto fields = io::table("movement_detector.get_eyes");
};

// For people: how the eyes are.
struct eyes_view {
  bool is_seeing = false; // the newest pictures were looked at and said something
  std::string sentence;   // why not, or what is missing; empty: all is well
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double frames_per_s = 0;
  std::uint64_t frames = 0; // these counts are of the helper that runs
  std::uint64_t dropped = 0;
  std::uint64_t looked = 0;
  std::uint64_t usable = 0;
  std::uint64_t recorded_kb = 0;
  double look_ms = 0;
  std::uint64_t starts = 0; // of the helper; these are of this incarnation
  std::uint64_t candidates = 0;
  std::uint64_t sightings = 0; // of these: said to the map
  std::uint64_t without_place = 0;
  GODWIT_FIELDS(eyes_view, "movement_detector.eyes_view", is_seeing, sentence, width_px, height_px, frames_per_s,
                frames, dropped, looked, usable, recorded_kb, look_ms, starts, candidates, sightings, without_place);
};

} // namespace godwit::movement_detector
