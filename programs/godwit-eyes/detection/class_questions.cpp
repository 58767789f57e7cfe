#include "programs/godwit-eyes/detection/class_questions.hpp"

#include <algorithm>
#include <tuple>

namespace godwit::eyes {

namespace {

double length_of(const track& who, int reduction) {
  const cv::Rect2d box = extent_of(who);
  return reduction * std::max(box.width, box.height);
}

bool is_due(const track& who, int reduction) {
  return who.missed == 0 && who.seen >= class_questions::least_seen &&
         length_of(who, reduction) >= class_questions::least_length_px &&
         (!who.looks.was_asked() || who.looks.since_s() >= class_questions::again_s);
}

bool goes_before(const track& a, const track& b) {
  const auto rank = [](const track& who) { return std::tuple(!who.looks.was_asked(), who.looks.since_s(), who.seen); };
  return rank(a) > rank(b);
}

} // namespace

void class_questions::step(std::vector<track>& tracks, const frame_view& picture, int reduction, double brightness,
                           double dt_s) {
  unrecognised_s_ += dt_s;
  for (auto& each : tracks)
    each.looks.pass(dt_s);
  saved_ms_ = std::min(saved_ms_ + ms_a_picture, std::max(most_saved_ms, cost_ms_));
  while (saved_ms_ >= cost_ms_) {
    track* next = nullptr;
    for (auto& each : tracks)
      if (is_due(each, reduction) && (next == nullptr || goes_before(each, *next)))
        next = &each;
    if (next == nullptr)
      return;
    const double begin = now_ms_();
    ask_about(*next, picture, reduction, brightness);
    cost_ms_ = now_ms_() - begin;
    saved_ms_ -= cost_ms_;
  }
}

void class_questions::ask_about(track& who, const frame_view& picture, int reduction, double brightness) {
  const double scale = reduction;
  const cv::Rect2d box = extent_of(who);
  const auto said = ask_(picture, {box.x * scale, box.y * scale, box.width * scale, box.height * scale});
  if (said.what == object_class::unknown) {
    who.looks.add_unrecognised(unrecognised_s_ < recognises_for_s && brightness >= least_day_brightness &&
                               length_of(who, reduction) >= least_known_px);
    return;
  }
  const cv::Rect2d found(said.box.x_px / scale, said.box.y_px / scale, said.box.width_px / scale,
                         said.box.height_px / scale);
  who.looks.add_recognised(said.what, said.score, found - who.filter.place());
  if (who.looks.is_recognised())
    unrecognised_s_ = 0;
}

} // namespace godwit::eyes
