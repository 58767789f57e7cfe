#include "programs/godwit-eyes/detection/tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "programs/godwit-eyes/detection/background_model.hpp"
#include "programs/godwit-eyes/detection/own_motion.hpp"

namespace godwit::eyes {

namespace {

constexpr double gate_squared = 16;  // standard deviations, squared, of a blob that belongs to a track
constexpr double place_share = 0.12; // of the size: how unsure the middle of a blob is
constexpr double least_deviation_px = 0.7;
constexpr double size_share = 0.3;  // of a new size in the smoothed one
constexpr double most_growth = 2.2; // of a side, from one picture to the next
constexpr int most_missed_young = 2;
constexpr int most_missed_confirmed = 10;
constexpr double least_speed_px_s = 8;

// What a track must show: little where hardly anything else differs from the ground, more among many blobs that come
// and go (leaves, tops that move against the ground, glints). Between the two in proportion.
struct demands {
  double way_px;
  double way_by_size;
  double straightness; // of the way
  double seen_share;   // of its pictures
  double sure_speed;   // in standard deviations of the speed
};
constexpr demands of_calm{2.5, 0.25, 0.5, 0.5, 0.5};
constexpr demands of_clutter{6, 1.0, 0.7, 0.75, 5};       // what sways stays within its own size
constexpr demands of_proved_clutter{3, 0.4, 0.6, 0.6, 2}; // where a proof is asked for besides
constexpr double calm_births = 0.4;                       // new tracks a picture
constexpr double border_px = 1.5;                         // interpolation reaches so far in
constexpr double births_share = 0.1;                      // of the newest picture in the mean
constexpr double least_clutter_to_prove = 0.1;
constexpr std::size_t most_places = 32; // remembered of a track

demands between(const demands& a, const demands& b, double share) {
  const auto mix = [&](double from, double to) { return from + (to - from) * share; };
  return {mix(a.way_px, b.way_px), mix(a.way_by_size, b.way_by_size), mix(a.straightness, b.straightness),
          mix(a.seen_share, b.seen_share), mix(a.sure_speed, b.sure_speed)};
}

bool shows(const track& who, const demands& need) {
  const double gone = cv::norm(who.filter.place() - who.born);
  const double enough = std::max(need.way_px, need.way_by_size * std::max(who.size.width, who.size.height));
  const double speed = cv::norm(who.filter.velocity());
  return who.seen >= need.seen_share * who.age && gone >= enough && gone >= need.straightness * who.way_px &&
         speed >= least_speed_px_s && speed >= need.sure_speed * who.filter.speed_deviation();
}

double deviation_of(const cv::Size2d& size) {
  return std::max(least_deviation_px, place_share * std::max(size.width, size.height));
}

struct fit {
  double distance;
  std::size_t track;
  std::size_t blob;
};

// All that it has shown is forgotten, but not how it moves.
void begin_anew(track& who) {
  who.born = who.filter.place();
  who.age = who.seen = 1;
  who.way_px = 0;
  who.along_parallax = 0;
  who.places.clear();
}

bool has_like_size(const cv::Size2d& known, const cv::Rect2d& box) {
  const double before = std::max(known.width, known.height) + 2;
  const double now = std::max(box.width, box.height) + 2;
  return now < before * most_growth && before < now * most_growth * 1.5;
}

} // namespace

cv::Rect2d box_of(const track& who) {
  const cv::Point2d at = who.filter.place();
  return {at.x - who.size.width / 2, at.y - who.size.height / 2, who.size.width, who.size.height};
}

cv::Point2d middle_of(const cv::Rect2d& box) { return {box.x + box.width / 2, box.y + box.height / 2}; }

void tracker::step(std::span<const blob> blobs, double dt_s, const cv::Matx33d& ground, const cv::Size& picture,
                   const prover& proves) {
  for (auto& each : tracks_) {
    each.filter.predict(dt_s, ground);
    each.born = moved(ground, each.born);
    ++each.age;
    ++each.missed; // taken back where it is seen
    each.way_px += cv::norm(each.filter.velocity()) * dt_s;
  }
  picture_ = picture;
  grounds_.push_back(ground);
  if (grounds_.size() > background_model::pictures_to_know)
    grounds_.pop_front();
  std::vector<bool> is_taken(blobs.size());
  assign(blobs, is_taken);
  const bool needs_proof = proves && clutter() > least_clutter_to_prove;
  const demands need = between(of_calm, proves ? of_proved_clutter : of_clutter, clutter());
  for (auto& each : tracks_)
    if (!each.is_confirmed && each.missed == 0 && each.seen >= settings_.frames_to_confirm)
      each.is_confirmed = shows(each, need) && (!needs_proof || proves(each));
  const cv::Rect2d inside(0, 0, picture.width, picture.height);
  std::erase_if(tracks_, [&](const track& each) {
    const int most_missed = each.is_confirmed ? most_missed_confirmed : most_missed_young;
    return each.missed > most_missed || !inside.contains(each.filter.place());
  });
  is_full_ = false;
  const std::uint32_t last_before = last_number_;
  for (std::size_t n = 0; n < blobs.size(); ++n) {
    if (is_taken[n])
      continue;
    if (tracks_.size() >= settings_.max_tracks) {
      is_full_ = true;
      break;
    }
    const auto& box = blobs[n].box;
    const cv::Size2d size(box.width, box.height);
    track made{++last_number_, track_filter(middle_of(box), deviation_of(size)), size, middle_of(box)};
    made.age = made.seen = 1;
    made.places.push_back({made.age, box});
    tracks_.push_back(std::move(made));
  }
  births_ += births_share * (last_number_ - last_before - births_);
}

void tracker::assign(std::span<const blob> blobs, std::vector<bool>& is_taken) {
  std::vector<fit> fits;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t b = 0; b < blobs.size(); ++b) {
      const auto& box = blobs[b].box;
      const cv::Size2d& size = tracks_[t].size;
      const double distance = tracks_[t].filter.distance_squared(middle_of(box), deviation_of(size));
      const cv::Point2d off = middle_of(box) - tracks_[t].filter.place();
      // A new track does not know its speed yet: it may not reach farther than a few of its own lengths.
      const double reach = 6 + 1.0 * std::max(size.width, size.height);
      if (distance < gate_squared && cv::norm(off) < reach && has_like_size(size, box))
        fits.push_back({distance - (tracks_[t].is_confirmed ? gate_squared : 0), t, b});
    }
  std::ranges::stable_sort(fits, [](const fit& a, const fit& b) { return a.distance < b.distance; });
  std::vector<bool> is_seen(tracks_.size());
  for (const auto& each : fits) {
    if (is_seen[each.track] || is_taken[each.blob])
      continue;
    is_seen[each.track] = true;
    is_taken[each.blob] = true;
    see(tracks_[each.track], blobs[each.blob].box);
  }
  // What else lies in the box of a track that was seen is a part of it.
  for (std::size_t b = 0; b < blobs.size(); ++b)
    for (std::size_t t = 0; t < tracks_.size() && !is_taken[b]; ++t)
      if (tracks_[t].missed == 0 && box_of(tracks_[t]).contains(middle_of(blobs[b].box)))
        is_taken[b] = true;
}

// The ground around it was known and it was not cut off: it is inside of this picture, and was inside of the first one
// of those that make a place known.
bool tracker::is_whole(const cv::Rect2d& box) const {
  const cv::Rect2d inside(border_px, border_px, picture_.width - 2 * border_px, picture_.height - 2 * border_px);
  cv::Matx33d then_to_now = cv::Matx33d::eye();
  for (const auto& each : grounds_)
    then_to_now = each * then_to_now;
  const cv::Matx33d now_to_then = then_to_now.inv();
  return std::ranges::all_of(
      std::array{box.tl(), cv::Point2d(box.br().x, box.y), cv::Point2d(box.x, box.br().y), box.br()},
      [&](const cv::Point2d& corner) {
        return inside.contains(corner) && inside.contains(moved(now_to_then, corner));
      });
}

void tracker::see(track& who, const cv::Rect2d& box) {
  who.filter.update(middle_of(box), deviation_of(who.size));
  who.size.width += size_share * (box.width - who.size.width);
  who.size.height += size_share * (box.height - who.size.height);
  ++who.seen;
  who.missed = 0;
  if (!who.is_confirmed && !is_whole(box))
    begin_anew(who);
  who.places.push_back({who.age, box});
  if (who.places.size() > most_places)
    who.places.pop_front();
}

double tracker::clutter() const {
  return std::clamp((births_ - calm_births) / (cluttered_births - calm_births), 0.0, 1.0);
}

} // namespace godwit::eyes
