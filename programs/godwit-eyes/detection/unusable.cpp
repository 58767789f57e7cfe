#include <array>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

namespace {

struct words {
  unusable why;
  std::string_view name;
  std::string_view sentence;
};

constexpr std::array<words, unusable_count> all_words{{
    {unusable::none, "none", "the picture can be used"},
    {unusable::starting, "starting", "the first pictures; a comparison needs earlier ones"},
    {unusable::bad_frame, "bad_frame", "the size or the stride of the picture can not be"},
    {unusable::bad_pose, "bad_pose", "the camera's pose is not a number, or not a rotation, or not of this time"},
    {unusable::repeated, "repeated", "the same picture again: the camera or its encoder hangs"},
    {unusable::blank, "blank", "the picture has one brightness: a cap, or no signal"},
    {unusable::dark, "dark", "too dark"},
    {unusable::blurred, "blurred", "blurred: out of focus, or the camera turns too fast"},
    {unusable::few_features, "few_features", "nothing to hold on to: water, snow or fog"},
    {unusable::too_low, "too_low", "so near to the ground that what stands on it moves in the picture by itself"},
    {unusable::too_oblique, "too_oblique", "the camera looks too far off the vertical"},
    {unusable::too_many_movers, "too_many_movers", "most of the picture moves against the rest"},
    {unusable::attitude_old, "attitude_old", "the attitude is too old for how fast the camera turns"},
    {unusable::no_homography, "no_homography", "the motion of the ground in the picture is not certain"},
}};

constexpr bool are_in_order() {
  for (int n = 0; n < unusable_count; ++n)
    if (all_words[static_cast<std::size_t>(n)].why != static_cast<unusable>(n))
      return false;
  return true;
}
static_assert(are_in_order());

} // namespace

std::string_view name_of(unusable why) { return all_words[static_cast<std::size_t>(why)].name; }

std::string_view sentence_of(unusable why) { return all_words[static_cast<std::size_t>(why)].sentence; }

} // namespace godwit::eyes
