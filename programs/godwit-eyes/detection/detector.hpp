// Finds what moves on the ground in the pictures of a camera that moves itself.
//
// One picture after another goes in with the camera's pose, where that is known; a verdict comes out: what moves
// (tracks that were seen in several pictures, so that a flicker is none), or why nothing can be said. Without a pose
// there are no places on the ground and no prediction of the camera's motion, and all else works.
//
// With a net (classifier.hpp) it is asked what the tracks look like: what it recognises is confirmed sooner and has its
// box, and what it would recognise and does not is left out.
//
// How: features tracked on a reduced picture, homography by MAGSAC, a background model, and where that
// is cluttered the difference against two earlier pictures; blobs, a filter and an association of its own. The parts
// are files of this folder.
//
// Errors: what a picture or a pose can have wrong is a reason in the verdict, never an exception. Settings are checked
// with `problem_of` before a detector is made; a detector of settings that have a problem ends the process (a broken
// invariant). Memory: bounded by the size of the picture. Thread: one at a time; `use_one_thread` once in the process.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/eyes/object_class.hpp"
#include "io/video/frame.hpp"
#include "programs/godwit-eyes/ground/camera.hpp"

namespace godwit::eyes {

using io::eyes::object_class;

// One byte a pixel, brightness; the pixels stay the caller's and are not kept.
struct frame_view {
  const std::uint8_t* grey = nullptr;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;       // bytes from one row to the next
  std::int64_t captured_ns = 0; // monotonic, rises from frame to frame
  // The differences of colour at half its size (I420); null: it has no colours.
  const std::uint8_t* blue = nullptr;
  const std::uint8_t* red = nullptr;
  std::size_t colour_stride = 0;
};

[[nodiscard]] frame_view view_of(const io::video::frame& picture, std::int64_t captured_ns);

// Of a picture; x to the right, y down, from the upper left corner.
struct pixel_box {
  double x_px = 0;
  double y_px = 0;
  double width_px = 0;
  double height_px = 0;
};

struct ground_place {
  double latitude_deg = 0;
  double longitude_deg = 0;
  // Of the place, in square metres.
  double variance_north_m2 = 0;
  double variance_east_m2 = 0;
  double covariance_m2 = 0;
  double size_m = 0; // the longer side of the box, on flat ground
};

// A track that was confirmed.
struct candidate {
  std::uint32_t track = 0; // its number; never used again by the same detector
  pixel_box box;           // in this picture
  double speed_px_s = 0;   // against the ground
  double confidence = 0;   // 0..1
  int frames_seen = 0;
  bool is_seen_now = true;           // false: where it should be by its motion; it was not seen in this picture
  std::optional<ground_place> place; // without a pose, or above the limit off nadir: nothing
  object_class looks_like = object_class::unknown; // as the net says; unknown without one, too
};

// Why a picture says nothing about what moves. Each is said as a sentence by `sentence_of`.
enum class unusable {
  none,
  starting,  // the first pictures, and those after a gap or a change of size
  bad_frame, // size, stride or pointer can not be
  bad_pose,  // not a number, no quaternion, older than a second
  repeated,  // the same picture as before
  blank,     // one brightness
  dark,
  blurred,
  few_features,    // nothing to hold on to: water, snow, fog
  too_low,         // the ground is so near that heights move like movers
  too_oblique,     // the centre looks more than the limit off nadir
  too_many_movers, // most of the picture moves against the rest
  attitude_old,    // the pose is too old for how fast the camera turns
  no_homography    // the motion of the ground can not be told with certainty
};

inline constexpr int unusable_count = static_cast<int>(unusable::no_homography) + 1;

[[nodiscard]] std::string_view name_of(unusable why); // "too_low"
[[nodiscard]] std::string_view sentence_of(unusable why);

// Why a track is not said.
enum class unsaid_reason {
  young,  // not seen often enough, or it has not gone far and straight enough
  lost,   // not seen for some pictures
  part,   // another track follows the same thing, and more of it
  unlike, // nothing that the net knows, which would have known it
  high,   // it goes as something high and still would when the camera passes it
  small
};

struct unsaid_track {
  std::uint32_t track = 0;
  pixel_box box;
  unsaid_reason why = unsaid_reason::young;
};

// What the detector went by; for health, `look` and the bench.
struct look_figures {
  int features = 0;              // tracked from the picture before
  int inliers = 0;               // of these, on the ground's homography
  double residual_px = 0;        // median distance of the inliers from it, in pixels of the picture
  double corner_shift_px = 0;    // the largest move of a corner since the picture before
  double changed_share = 0;      // of the pixels
  double brightness = 0;         // mean, 0..255
  int tracks = 0;                // confirmed or not
  int coasting = 0;              // of these, not seen in this picture
  std::int64_t microseconds = 0; // processor time of this thread
  // From a pixel of the picture before to one of this picture, row by row; only where the motion was found.
  std::optional<std::array<double, 9>> homography;
  std::vector<unsaid_track> unsaid; // those that are followed, and not in `confirmed`
};

struct verdict {
  std::vector<candidate> confirmed; // empty where `why` is not `none`
  unusable why = unusable::none;
  look_figures figures;
};

struct detector_settings {
  std::optional<camera_parameters> camera; // without: no places on the ground and no prediction
  int working_width_px = 640;              // pictures are reduced by a whole number until they are no wider
  int frames_to_confirm = 5;               // a track is a candidate when it was seen this often
  double min_size_px = 6;                  // of the longer side, in pixels of the picture; smaller ones are left out
  int max_tracks = 64;                     // more at once: the weakest are dropped
  double max_off_nadir_deg = 70;
  double min_height_m = 8;         // below: too_low
  double max_changed_share = 0.35; // above: too_many_movers
};

// What is wrong with them, as a sentence that names the place; nothing: they can be used.
[[nodiscard]] std::optional<std::string> problem_of(const detector_settings& settings);

// OpenCV would start a thread for each core, beside those of the program.
void use_one_thread();
// What a picture needs is freed and asked for again thirty times a second. Given back to the system each time, its
// pages have to be mapped and cleared anew, which costs as much as some of the work in them. Once in the process.
void keep_freed_memory();

class classifier;

class detector {
public:
  // ASKED: about what moves; none: nobody is.
  explicit detector(const detector_settings& settings, const std::shared_ptr<classifier>& asked = {});
  ~detector();
  detector(const detector&) = delete;
  detector& operator=(const detector&) = delete;

  // Pictures in the order of their time. A change of size begins anew.
  [[nodiscard]] verdict look(const frame_view& frame, const std::optional<camera_pose>& pose);

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::eyes
