// What the daemon and its helper process godwit-eyes say to each other: plain values with field tables.
//
//   daemon ── begin, pose, want_picture ──> godwit-eyes
//   daemon <── status, candidates ───────── godwit-eyes
//
// Times are monotonic nanoseconds, which all processes of a boot share. What came from the other side is checked with
// `problem_of` before anybody uses it: the camera's decoder may have been fed by strangers. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/eyes/object_class.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::io::eyes {

inline constexpr std::size_t max_candidates = 64; // in one message
inline constexpr std::size_t max_text_bytes = 512;
inline constexpr std::int32_t max_side_px = 8192;

// The first message to the helper, and the only one of its kind.
struct begin {
  std::string uri; // of the camera: v4l2:///dev/video0, rtsp://..., file:///..., test://...
  // The camera's parameters for pictures of this size; 0: unknown, and there are no places on the ground.
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double focal_px = 0;
  double k1 = 0; // radial distortion
  double k2 = 0;
  double min_height_m = 8; // below it says `too_low`
  double max_off_nadir_deg = 70;
  std::string record_folder; // empty: nothing is recorded
  std::int64_t record_max_mb = 0;
  std::string model; // a file (model_files.hpp); empty: nobody is asked what things look like
  GODWIT_FIELDS(begin, "eyes.begin", uri, width_px, height_px, focal_px, k1, k2, min_height_m, max_off_nadir_deg,
                record_folder, record_max_mb, model);
};

// Of the camera: body and mount are in it. The quaternion turns camera axes (x right, y down, z into the picture) into
// north, east, down; rates are in camera axes.
struct pose {
  std::int64_t at_ns = 0;
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
  double rate_x_rad_s = 0;
  double rate_y_rad_s = 0;
  double rate_z_rad_s = 0;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0; // above the ground below it
  double attitude_sd_rad = 0;
  double position_sd_m = 0;
  double height_sd_m = 0;
  GODWIT_FIELDS(pose, "eyes.pose", at_ns, w, x, y, z, rate_x_rad_s, rate_y_rad_s, rate_z_rad_s, latitude_deg,
                longitude_deg, height_m, attitude_sd_rad, position_sd_m, height_sd_m);
};

// Pictures are put into the slot until this time, at most one each `gap_ms`. Said again by who still looks.
struct want_picture {
  std::int64_t until_ns = 0;
  std::int64_t gap_ms = 200;
  GODWIT_FIELDS(want_picture, "eyes.want_picture", until_ns, gap_ms);
};

enum class source_state {
  opening, // for the first time, or again
  playing,
  failed, // it is opened again soon
  ended   // a file is over
};

GODWIT_ENUM_NAMES(source_state, opening, playing, failed, ended);

// Of pictures that come, but show nothing.
enum class picture_fault { none, black, repeated };

GODWIT_ENUM_NAMES(picture_fault, none, black, repeated);

// Each half second, also when nothing works: who says nothing for 2 s hangs.
struct status {
  std::int64_t at_ns = 0;
  source_state source = source_state::opening;
  std::string reason; // a sentence: why it does not play
  picture_fault fault = picture_fault::none;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double frames_per_s = 0;       // that came from the camera, in the last second or so
  std::uint64_t frames = 0;      // since it began
  std::uint64_t dropped = 0;     // of these: a newer one was there before anybody looked
  std::uint64_t opened = 0;      // how often the camera was opened
  std::uint64_t changes = 0;     // of size or format
  std::uint64_t looked = 0;      // frames in which it looked for movement
  std::uint64_t usable = 0;      // of these: those that say something
  std::int64_t usable_at_ns = 0; // when the newest of these was captured; 0: there was none
  std::string unusable;          // a sentence: why the newest one says nothing; empty: it does
  double look_ms = 0;            // time of the detector for the newest frame
  std::uint64_t pictures = 0;    // put into the slot
  std::uint64_t recorded_kb = 0; // in segments that are there
  std::string record_error;      // a sentence; empty: all is well
  std::string model_error;       // the same, of the model
  GODWIT_FIELDS(status, "eyes.status", at_ns, source, reason, fault, width_px, height_px, frames_per_s, frames, dropped,
                opened, changes, looked, usable, usable_at_ns, unusable, look_ms, pictures, recorded_kb, record_error,
                model_error);
};

// Of a picture, in pixels from its upper left corner.
struct box {
  double x_px = 0;
  double y_px = 0;
  double width_px = 0;
  double height_px = 0;
  GODWIT_FIELDS(box, "eyes.box", x_px, y_px, width_px, height_px);
};

struct ground_place {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double variance_north_m2 = 0;
  double variance_east_m2 = 0;
  double covariance_m2 = 0;
  double size_m = 0;
  GODWIT_FIELDS(ground_place, "eyes.ground_place", latitude_deg, longitude_deg, variance_north_m2, variance_east_m2,
                covariance_m2, size_m);
};

struct candidate {
  std::uint32_t track = 0; // its number, the same from picture to picture
  box where;
  std::optional<ground_place> place; // nothing: the pose was not known
  double confidence = 0;             // 0..1
  double speed_px_s = 0;
  std::int32_t frames_seen = 0;
  object_class looks_like = object_class::unknown;
  GODWIT_FIELDS(candidate, "eyes.candidate", track, where, place, confidence, speed_px_s, frames_seen, looks_like);
};

// What moves in one picture; not said of pictures in which nothing does.
struct candidates {
  std::int64_t captured_ns = 0;
  std::vector<candidate> seen;
  GODWIT_FIELDS(candidates, "eyes.candidates", captured_ns, seen);
};

using message = std::variant<begin, pose, want_picture, status, candidates>;

} // namespace godwit::io::eyes
