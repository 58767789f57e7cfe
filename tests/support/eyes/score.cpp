#include "tests/support/eyes/score.hpp"

#include <algorithm>

namespace godwit::eyes::test {

namespace {

constexpr double frames_a_second = 30;

struct judged {
  std::vector<pixel_box> counted;
  std::vector<pixel_box> left_out;
};

struct scaled {
  double border;
  double size;
  double speed;
  double width;
  double height;
};

scaled scaled_to(const score_rules& rules) {
  const double scale = rules.width / 1280.0;
  return {rules.border_px * scale, rules.min_size_px * scale, rules.min_speed_px * scale,
          static_cast<double>(rules.width), static_cast<double>(rules.height)};
}

bool is_at_border(const pixel_box& box, const scaled& by) {
  const double x = box.x_px + box.width_px / 2;
  const double y = box.y_px + box.height_px / 2;
  return x < by.border || y < by.border || x > by.width - by.border || y > by.height - by.border;
}

judged judge(const sim::camera::truth& real, const scaled& by) {
  judged result;
  for (const auto& each : real.movers) {
    const pixel_box box{each.x_px, each.y_px, each.width_px, each.height_px};
    const bool counts = !each.is_cut && each.visible_share >= 0.5 &&
                        std::max(each.width_px, each.height_px) >= by.size &&
                        each.speed_px_s / frames_a_second >= by.speed && !is_at_border(box, by);
    (counts ? result.counted : result.left_out).push_back(box);
  }
  return result;
}

struct pair_of_boxes {
  double overlap;
  std::size_t real;
  std::size_t seen;
};

std::vector<pair_of_boxes> pairs_above(std::span<const pixel_box> real, std::span<const pixel_box> seen,
                                       double threshold) {
  std::vector<pair_of_boxes> pairs;
  for (std::size_t r = 0; r < real.size(); ++r)
    for (std::size_t s = 0; s < seen.size(); ++s)
      if (const double overlap = overlap_of(real[r], seen[s]); overlap >= threshold)
        pairs.push_back({overlap, r, s});
  std::ranges::stable_sort(pairs, [](const auto& a, const auto& b) { return a.overlap > b.overlap; });
  return pairs;
}

} // namespace

score& score::operator+=(const score& other) {
  found += other.found;
  missed += other.missed;
  wrong += other.wrong;
  return *this;
}

double overlap_of(const pixel_box& a, const pixel_box& b) {
  const double width = std::min(a.x_px + a.width_px, b.x_px + b.width_px) - std::max(a.x_px, b.x_px);
  const double height = std::min(a.y_px + a.height_px, b.y_px + b.height_px) - std::max(a.y_px, b.y_px);
  if (width <= 0 || height <= 0)
    return 0;
  const double both = width * height;
  return both / (a.width_px * a.height_px + b.width_px * b.height_px - both);
}

score score_of(const sim::camera::truth& real, std::span<const pixel_box> seen, const score_rules& rules) {
  const scaled by = scaled_to(rules);
  const judged truths = judge(real, by);
  std::vector<bool> is_found(truths.counted.size());
  std::vector<bool> is_used(seen.size());
  score result;
  for (const auto& pair : pairs_above(truths.counted, seen, rules.overlap)) {
    if (is_found[pair.real] || is_used[pair.seen])
      continue;
    is_found[pair.real] = true;
    is_used[pair.seen] = true;
    ++result.found;
  }
  result.missed = static_cast<int>(std::ranges::count(is_found, false));
  for (std::size_t s = 0; s < seen.size(); ++s) {
    const auto lies_over = [&](const pixel_box& box) { return overlap_of(box, seen[s]) > 0; };
    if (!is_used[s] && !is_at_border(seen[s], by) && std::ranges::none_of(truths.left_out, lies_over))
      ++result.wrong;
  }
  return result;
}

} // namespace godwit::eyes::test
