// The scenes and flights by which the detector is tuned and measured, each from its seed, and which of them are held
// back.
//
// The rule: a seed whose remainder by 3 is 2 is held back, and so are the ends of all ranges. A tuning seed draws each
// of its figures from the middle two thirds of its range, a held-back seed from all of it. Held-back seeds are used
// only by the last measurement of a commit that enters figures into docs/performance.md (`eyes/held_back`), never to
// choose a number. Thread: pure.
#pragma once

#include <cstdint>
#include <memory>

#include "programs/godwit-sim/camera/generator.hpp"

namespace godwit::sim::camera {

enum class tier { a, b };

[[nodiscard]] constexpr bool is_held_back(std::uint64_t seed) { return seed % 3 == 2; }

// The N-th seed for tuning, and the N-th that is held back; from 0.
[[nodiscard]] constexpr std::uint64_t tuning_seed(std::uint64_t n) { return n / 2 * 3 + n % 2; }
[[nodiscard]] constexpr std::uint64_t held_back_seed(std::uint64_t n) { return n * 3 + 2; }

struct range {
  double least;
  double most;
};

// Pixels are those of a picture 1280 wide, and are scaled for others.
struct suite_ranges {
  range height_m{35, 120};
  range field_of_view_deg{50, 75};
  range off_nadir_deg{0, 45};
  range speed_m_s{1, 14}; // of the camera
  range climb_m_s{-1.5, 1.5};
  range turn_deg_s{-15, 15}; // of the heading
  range shake_deg{0, 0.5};   // amplitude, in roll and tilt
  range shake_hz{0.5, 3};
  range zoom_a_s{-0.04, 0.04}; // of the focal length
  range readout_s{0, 0.02};
  range contrast{14, 32}; // of the ground
  range roughness{0.6, 0.82};
  range noise{1.5, 6};
  range jpeg_quality{60, 98};
  range exposure_factor{0.8, 1.25};
  range mover_px{10, 40};         // length
  range mover_px_a_frame{0.8, 6}; // at 30 frames a second
  range mover_shape{0.4, 0.8};    // width by length
  range mover_contrast{15, 80};   // of the brightness, lighter or darker than the ground
  range mover_turn_deg_s{-20, 20};
  range relief_m{0.5, 2.2}; // tier B only, as what follows
  range buildings_a_cell{0.2, 1.4};
  range trees_a_cell{2, 16};
  range glints_a_cell{0, 10};
};

struct suite_options {
  int width = 1280;
  int height = 720;
  bool has_movers = true;
  double pan_deg_s = 0; // added to the turning of the camera
  suite_ranges ranges;
};

// One scene and the camera's way over it; 30 pictures a second from time 0.
class suite_case {
public:
  static constexpr double frame_s = 1.0 / 30;
  static constexpr double longest_s = 60; // movers are placed for flights up to this long

  suite_case(std::uint64_t seed, tier which, const suite_options& options = {});

  [[nodiscard]] camera_view view_at(double time_s) const;
  [[nodiscard]] shot frame(int number) const { return maker_->take(view_at(number * frame_s)); }
  [[nodiscard]] const generator& maker() const { return *maker_; }

private:
  struct flight {
    double height_m = 0;
    double course_rad = 0;
    double speed_m_s = 0;
    double climb_m_s = 0;
    double heading_rad = 0;
    double turn_rad_s = 0;
    double off_nadir_rad = 0;
    double shake_rad = 0;
    double shake_hz = 0;
    double shake_phase = 0;
    double zoom_a_s = 0;
  };
  [[nodiscard]] camera_view still_at(double time_s) const; // without velocity and rate

  flight flight_;
  std::shared_ptr<const generator> maker_;
};

} // namespace godwit::sim::camera
