#include "programs/godwit-eyes/detection/tracker.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <iterator>

#include "programs/godwit-eyes/detection/change.hpp"
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
  double age_s;
};
constexpr demands of_calm{4, 0.5, 0.5, 0.6, 0.5, 0.3};
constexpr demands of_differences{4, 0.75, 0.6, 0.75, 1, 0.5}; // which hold mostly edges
constexpr demands of_clutter{10, 1.0, 0.65, 0.75, 5, 0.8};
constexpr demands of_proved_calm{2.5, 0.25, 0.5, 0.5, 0.5, 0.15}; // where a proof can be asked for
constexpr demands of_proved_clutter{3, 0.4, 0.6, 0.6, 2, 0.3};    // where it is
constexpr demands of_recognised{3, 0.25, 0.4, 0.5, 0.5, 0.2};     // by a classifier, which has the look of it
constexpr double way_among_clutter = 1; // by size, unless the whole picture is calm: what sways stays within its own
constexpr double border_px = 2;         // so far in interpolation and differences reach
constexpr double least_clutter_to_prove = 0.1;
constexpr double least_breadth = 0.25; // of the length: what is thinner is an edge of something
constexpr double clutter_reach = 0.1;  // of the picture's width
constexpr double birth_memory_s = 1;
constexpr double calm_births_a_s = 0.7; // of tracks, within reach
constexpr double cluttered_births_a_s = 4.2;
constexpr double calm_births_everywhere_a_s = 12; // in the picture: asked where a track can be proved to have moved
constexpr double cluttered_births_everywhere_a_s = 75;
constexpr double calm_background_a_s = 1; // births of its blobs, likewise
constexpr double cluttered_background_a_s = 7;
constexpr std::size_t most_births = 1000;
constexpr double strange_s = 0.2;     // in which a new scene becomes known
constexpr int seen_to_follow_on = 12; // before the second association holds a track that is not confirmed
constexpr double double_share = 0.5;
constexpr std::size_t most_places = 32; // remembered of a track
constexpr double edges_px = 3;          // what goes less in the time of the quick difference shows only its edges there
constexpr double most_of_edges = 50;    // times its area: the whole of it
constexpr double extent_share = 0.5;    // of a new extent in the smoothed one

demands between(const demands& a, const demands& b, double share) {
  const auto mix = [&](double from, double to) { return from + (to - from) * share; };
  return {mix(a.way_px, b.way_px),         mix(a.way_by_size, b.way_by_size), mix(a.straightness, b.straightness),
          mix(a.seen_share, b.seen_share), mix(a.sure_speed, b.sure_speed),   mix(a.age_s, b.age_s)};
}

bool shows(const track& who, const demands& need) {
  const double gone = cv::norm(who.filter.place() - who.born);
  const double enough = std::max(need.way_px, need.way_by_size * std::max(who.size.width, who.size.height));
  const double speed = cv::norm(who.filter.velocity());
  return who.age_s >= need.age_s &&
         std::min(who.size.width, who.size.height) >= least_breadth * std::max(who.size.width, who.size.height) &&
         who.seen >= need.seen_share * who.age && gone >= enough && gone >= need.straightness * who.way_px &&
         speed >= least_speed_px_s && speed >= need.sure_speed * who.filter.speed_deviation();
}

double share_of(double value, double none, double all) { return std::clamp((value - none) / (all - none), 0.0, 1.0); }

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
  who.age_s = 0;
  who.by_background = 0;
  who.way_px = 0;
  who.along_parallax = 0;
  who.places.clear();
}

cv::Rect2d mixed(const cv::Rect2d& from, const cv::Rect2d& to, double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
          from.width + share * (to.width - from.width), from.height + share * (to.height - from.height)};
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

cv::Rect2d extent_of(const track& who) { return who.extent ? *who.extent + who.filter.place() : box_of(who); }

namespace {

bool is_by_background(const track& who) { return 2 * who.by_background > who.seen; }

// Those of the background where it is calm; elsewhere the quick difference, which has the same thing only once.
std::vector<blob> trusted(std::span<const blob> background, std::span<const blob> difference,
                          const clutter_map& clutter) {
  std::vector<blob> made;
  std::ranges::copy_if(background, std::back_inserter(made),
                       [&](const blob& each) { return clutter.is_calm_at(middle_of(each.box)); });
  const std::size_t calm = made.size();
  for (const auto& each : difference)
    if (!clutter.is_calm_at(middle_of(each.box)) &&
        std::none_of(made.begin(), made.begin() + static_cast<long>(calm),
                     [&](const blob& other) { return (other.box & each.box).area() > 0; }))
      made.push_back(each);
  return made;
}

} // namespace

void tracker::step(const sightings& seen, const clutter_map& clutter, double dt_s, const cv::Matx33d& ground,
                   const cv::Size& picture, const prover& proves) {
  picture_ = picture;
  carry(dt_s, ground);
  const auto blobs = proves ? std::vector<blob>(seen.background.begin(), seen.background.end())
                            : trusted(seen.background, seen.difference, clutter);
  std::vector<bool> is_taken(blobs.size());
  assign(blobs, {}, is_taken);
  std::vector<blob> others(seen.slow_difference.begin(), seen.slow_difference.end());
  others.insert(others.end(), seen.background.begin(), seen.background.end());
  std::vector<bool> is_other_taken(others.size());
  assign(
      others,
      [&](const track& who, const blob& each) {
        if (who.missed == 0 || (!who.is_confirmed && who.seen < seen_to_follow_on))
          return false;
        return each.from == blob_source::background ? is_by_background(who) || clutter.is_calm_at(middle_of(each.box))
                                                    : !is_by_background(who);
      },
      is_other_taken);
  find_extents(seen);
  confirm(clutter, proves);
  drop_lost();
  find_doubles();
  begin(blobs, is_taken);
}

bool tracker::needs_differences() const {
  return std::ranges::any_of(tracks_, [](const track& each) { return each.is_confirmed && !is_by_background(each); });
}

std::vector<cv::Rect2d> tracker::confirmed_boxes(const cv::Matx33d& ground) const {
  std::vector<cv::Rect2d> boxes;
  for (const auto& each : tracks_) {
    if (!each.is_confirmed)
      continue;
    const cv::Rect2d box = box_of(each);
    const cv::Point2d at = moved(ground, middle_of(box));
    boxes.emplace_back(at.x - box.width, at.y - box.height, 2 * box.width, 2 * box.height);
  }
  return boxes;
}

void tracker::carry(double dt_s, const cv::Matx33d& ground) {
  for (auto& each : tracks_) {
    each.filter.predict(dt_s, ground);
    each.born = moved(ground, each.born);
    ++each.age;
    each.age_s += dt_s;
    ++each.missed; // taken back where it is seen
    each.way_px += cv::norm(each.filter.velocity()) * dt_s;
  }
  for (auto& each : births_) {
    each.place = moved(ground, each.place);
    each.age_s += dt_s;
  }
  while (!births_.empty() && (births_.front().age_s > 3 * birth_memory_s || births_.size() > most_births))
    births_.pop_front();
  known_s_ += dt_s;
  grounds_.push_back({ground, dt_s});
  double known_s = 0;
  for (const auto& each : grounds_)
    known_s += each.dt_s;
  while (grounds_.size() > 1 && known_s - grounds_.front().dt_s >= 2 * recent_change::quick_s) {
    known_s -= grounds_.front().dt_s;
    grounds_.pop_front();
  }
}

void tracker::confirm(const clutter_map& clutter, const prover& proves) {
  const double everywhere = share_of(births_a_s([](const birth&) { return true; }), calm_births_everywhere_a_s,
                                     cluttered_births_everywhere_a_s);
  for (auto& each : tracks_) {
    if (each.is_confirmed || each.missed > 0 || each.seen < settings_.frames_to_confirm)
      continue;
    if (each.looks.is_unlike())
      continue;
    if (each.looks.is_recognised() && shows(each, of_recognised)) {
      each.is_confirmed = true;
      continue;
    }
    const double here = std::max(clutter_around(each, clutter), proves ? everywhere : 0);
    const bool needs_proof = proves && here > least_clutter_to_prove;
    demands need = proves                   ? between(of_proved_calm, of_proved_clutter, here)
                   : is_by_background(each) ? between(of_calm, of_clutter, here)
                                            : between(of_differences, of_clutter, here);
    if (!proves && !clutter.is_calm())
      need.way_by_size = std::max(need.way_by_size, way_among_clutter);
    each.is_confirmed = shows(each, need) && (!needs_proof || proves(each));
  }
}

// Of what goes slowly the quick difference shows an edge: then the slow one, or the background, tells how large it is.
void tracker::find_extents(const sightings& seen) {
  for (auto& each : tracks_) {
    if (each.missed > 0)
      continue;
    if (is_by_background(each) || cv::norm(each.filter.velocity()) * recent_change::quick_s >= edges_px) {
      each.extent.reset();
      continue;
    }
    const cv::Rect2d edges = box_of(each);
    const cv::Point2d place = each.filter.place();
    cv::Rect2d smallest;
    for (const auto& blobs : {seen.slow_difference, seen.background})
      for (const auto& blob : blobs)
        if (blob.box.contains(place) && blob.box.area() > edges.area() &&
            blob.box.area() < most_of_edges * edges.area() && (smallest.empty() || blob.box.area() < smallest.area()))
          smallest = blob.box;
    const cv::Rect2d now = (smallest.empty() ? edges : smallest) - place;
    if (each.extent)
      each.extent = mixed(*each.extent, now, extent_share);
    else if (!smallest.empty())
      each.extent = now;
  }
}

void tracker::drop_lost() {
  const cv::Rect2d inside(0, 0, picture_.width, picture_.height);
  std::erase_if(tracks_, [&](const track& each) {
    const int most_missed = each.is_confirmed ? most_missed_confirmed : most_missed_young;
    return each.missed > most_missed || !inside.contains(each.filter.place());
  });
}

void tracker::find_doubles() {
  const auto lies_in = [](const track& who, const track& other) {
    const double own = who.size.area();
    const bool is_smaller = own < other.size.area() || (own == other.size.area() && who.number > other.number);
    return is_smaller && other.is_confirmed && other.missed <= most_missed_young &&
           (box_of(who) & box_of(other)).area() > double_share * own;
  };
  for (auto& each : tracks_)
    each.is_double =
        each.is_confirmed && std::ranges::any_of(tracks_, [&](const track& other) { return lies_in(each, other); });
}

void tracker::begin(std::span<const blob> blobs, const std::vector<bool>& is_taken) {
  for (std::size_t n = 0; n < blobs.size(); ++n) {
    if (is_taken[n])
      continue;
    if (tracks_.size() >= settings_.max_tracks && !drop_weakest())
      break;
    const auto& box = blobs[n].box;
    const cv::Size2d size(box.width, box.height);
    track made{++last_number_, track_filter(middle_of(box), deviation_of(size)), size, middle_of(box)};
    made.age = made.seen = 1;
    made.by_background = blobs[n].from == blob_source::background ? 1 : 0;
    made.places.push_back({made.age, box});
    births_.push_back({made.number, made.born, 0});
    tracks_.push_back(std::move(made));
  }
}

// False: all are confirmed.
bool tracker::drop_weakest() {
  const auto strength = [](const track& who) { return who.is_confirmed ? INT_MAX : who.seen - who.missed; };
  const auto weakest = std::ranges::min_element(tracks_, {}, strength);
  if (weakest == tracks_.end() || weakest->is_confirmed)
    return false;
  tracks_.erase(weakest);
  return true;
}

void tracker::assign(std::span<const blob> blobs, const admits& may_take, std::vector<bool>& is_taken) {
  std::vector<fit> fits;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t b = 0; b < blobs.size(); ++b) {
      if (may_take && !may_take(tracks_[t], blobs[b]))
        continue;
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
    see(tracks_[each.track], blobs[each.blob]);
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
    then_to_now = each.before_to_now * then_to_now;
  const cv::Matx33d now_to_then = then_to_now.inv();
  return std::ranges::all_of(
      std::array{box.tl(), cv::Point2d(box.br().x, box.y), cv::Point2d(box.x, box.br().y), box.br()},
      [&](const cv::Point2d& corner) {
        return inside.contains(corner) && inside.contains(moved(now_to_then, corner));
      });
}

void tracker::see(track& who, const blob& seen) {
  const cv::Rect2d& box = seen.box;
  who.by_background += seen.from == blob_source::background ? 1 : 0;
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

double tracker::births_a_s(const std::function<bool(const birth&)>& counts) const {
  double a_second = 0;
  for (const auto& each : births_)
    if (counts(each))
      a_second += std::exp(-each.age_s / birth_memory_s) / birth_memory_s;
  return a_second;
}

double tracker::clutter_around(const track& who, const clutter_map& clutter) const {
  const double reach = clutter_reach * picture_.width;
  const double near_a_s = births_a_s(
      [&](const birth& each) { return each.track != who.number && cv::norm(each.place - who.filter.place()) < reach; });
  return std::max({share_of(near_a_s, calm_births_a_s, cluttered_births_a_s),
                   share_of(clutter.births_around(who.filter.place()), calm_background_a_s, cluttered_background_a_s),
                   std::exp(-known_s_ / strange_s)});
}

} // namespace godwit::eyes
