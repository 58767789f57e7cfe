#include "tests/support/eyes/clip_score.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include <nlohmann/json.hpp>

namespace godwit::eyes::test {

namespace {

constexpr double counted_lengths_per_s = 0.12;
constexpr double counted_px_per_s = 2; // of a picture 1280 wide, as all pixels here
constexpr double border_px = 16;
constexpr double least_reach_px = 8;
constexpr double usual_width_px = 1280;
constexpr double default_overlap = 0.3;

using counted_movers = std::map<std::pair<int, std::string>, bool>;
using fits = std::function<std::optional<double>(const cv::Rect2d& found, const cv::Rect2d& real)>; // less is better

cv::Point2d middle(const cv::Rect2d& box) { return {box.x + box.width / 2, box.y + box.height / 2}; }

cv::Rect2d box_at(const nlohmann::json& values, std::size_t first) {
  return {values.at(first).get<double>(), values.at(first + 1).get<double>(), values.at(first + 2).get<double>(),
          values.at(first + 3).get<double>()};
}

cv::Point2d carried(const cv::Matx33d& by, const cv::Point2d& from) {
  const auto to = by * cv::Vec3d(from.x, from.y, 1);
  return {to[0] / to[2], to[1] / to[2]};
}

double intersection_by_union(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double both = (a & b).area();
  return both > 0 ? both / (a.area() + b.area() - both) : 0;
}

// Over the half second before and after each picture.
counted_movers movers_that_move(const clip_labels& labels, const std::vector<cv::Matx33d>& ground, double scale) {
  std::map<std::string, std::map<int, cv::Rect2d>> places;
  for (const auto& [n, picture] : labels.pictures)
    for (const auto& each : picture.movers)
      places[each.id][n] = each.box;
  const int half = std::max(1, static_cast<int>(labels.pictures_per_s * 0.5));
  counted_movers result;
  for (const auto& [id, boxes] : places)
    for (const auto& [n, box] : boxes) {
      const auto first = boxes.lower_bound(n - half);
      const auto last = std::prev(boxes.upper_bound(n + half));
      cv::Point2d stood = middle(first->second);
      for (auto k = static_cast<std::size_t>(first->first); k < static_cast<std::size_t>(last->first); ++k)
        if (k < ground.size())
          stood = carried(ground[k], stood); // pictures count from 1
      const double share = static_cast<double>(last->first - first->first) / (2 * half);
      const double enough = std::max(counted_lengths_per_s * std::max(box.width, box.height), counted_px_per_s * scale);
      result[{n, id}] = first == last || cv::norm(stood - middle(last->second)) >= share * enough;
    }
  return result;
}

// Best first, each used once: indices of real and found.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<labelled_mover>& real,
                                                          const std::vector<found_box>& found, const fits& distance) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> ranked;
  for (std::size_t i = 0; i < real.size(); ++i)
    for (std::size_t j = 0; j < found.size(); ++j)
      if (const auto far = distance(found[j].box, real[i].box))
        ranked.emplace_back(*far, i, j);
  std::ranges::sort(ranked);
  std::set<std::size_t> used_real;
  std::set<std::size_t> used_found;
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (const auto& [far, i, j] : ranked)
    if (!used_real.contains(i) && !used_found.contains(j)) {
      used_real.insert(i);
      used_found.insert(j);
      result.emplace_back(i, j);
    }
  return result;
}

struct judged_picture {
  std::vector<labelled_mover> counted;
  std::vector<cv::Rect2d> ignored;
};

class scoring {
public:
  scoring(const clip_labels& labels, const std::vector<cv::Matx33d>& ground, const clip_detections& found)
      : labels_(labels), found_(found), scale_(found.size.width / usual_width_px),
        counts_(movers_that_move(labels, ground, scale_)) {}

  clip_score run() {
    int pictures = 0;
    int usable = 0;
    for (const auto& [n, picture] : labels_.pictures) {
      if (n <= labels_.warm)
        continue;
      ++pictures;
      const auto said = found_.is_usable.find(n);
      usable += said == found_.is_usable.end() || said->second ? 1 : 0;
      const auto boxes = found_.boxes.find(n);
      add(judge(n, picture), boxes == found_.boxes.end() ? std::vector<found_box>{} : boxes->second);
    }
    sum_up(pictures);
    score_.usable_share = pictures == 0 ? 0 : static_cast<double>(usable) / pictures;
    return score_;
  }

private:
  [[nodiscard]] bool is_inside(const cv::Rect2d& box) const {
    const auto at = middle(box);
    const double border = border_px * scale_;
    return at.x > border && at.y > border && at.x < found_.size.width - border && at.y < found_.size.height - border;
  }

  judged_picture judge(int n, const labelled_picture& picture) {
    judged_picture result{{}, picture.ignored};
    for (const auto& each : picture.movers)
      if (counts_.at({n, each.id}) && is_inside(each.box)) {
        result.counted.push_back(each);
        ++counted_pictures_[each.id];
      } else {
        result.ignored.push_back(each.box);
      }
    return result;
  }

  [[nodiscard]] bool is_left_out(const cv::Rect2d& box, const std::vector<cv::Rect2d>& ignored) const {
    return !is_inside(box) || std::ranges::any_of(ignored, [&](const cv::Rect2d& each) {
      const auto off = middle(box) - middle(each);
      return (box & each).area() >= 0.3 * box.area() ||
             (std::abs(off.x) <= 0.6 * each.width && std::abs(off.y) <= 0.6 * each.height);
    });
  }

  void add(const judged_picture& real, const std::vector<found_box>& found) {
    const double overlap = labels_.overlap;
    count(real, found, score_.by_overlap, [overlap](const auto& a, const auto& b) -> std::optional<double> {
      const double both = intersection_by_union(a, b);
      return both >= overlap ? std::optional(-both) : std::nullopt;
    });
    const auto false_boxes = count(real, found, score_.by_middle, [this](const auto& a, const auto& b) {
      const double far = cv::norm(middle(a) - middle(b));
      const double area = (a.area() + 1) / (b.area() + 1);
      const bool is_near = far <= std::max(0.6 * std::max(b.width, b.height), least_reach_px * scale_);
      return is_near && area >= 0.1 && area <= 8 ? std::optional(far) : std::nullopt;
    });
    for (const auto& [i, j] : pairs_) {
      found_ids_.insert(real.counted[i].id);
      ++tracks_[found[j].track].first;
    }
    for (const auto j : false_boxes)
      if (std::ranges::none_of(real.counted, [&](const auto& each) { return (each.box & found[j].box).area() > 0; }))
        ++tracks_[found[j].track].second;
  }

  // The found ones that are false.
  std::vector<std::size_t> count(const judged_picture& real, const std::vector<found_box>& found, clip_tally& to,
                                 const fits& distance) {
    pairs_ = pairs_of(real.counted, found, distance);
    std::set<std::size_t> used;
    for (const auto& each : pairs_)
      used.insert(each.second);
    std::vector<std::size_t> result;
    for (std::size_t j = 0; j < found.size(); ++j)
      if (!used.contains(j) && !is_left_out(found[j].box, real.ignored))
        result.push_back(j);
    to.found += static_cast<int>(pairs_.size());
    to.wrong += static_cast<int>(result.size());
    to.missed += static_cast<int>(real.counted.size() - pairs_.size());
    return result;
  }

  void sum_up(int pictures) {
    const int enough = std::min(5, std::max(1, pictures / 3));
    for (const auto& [id, number] : counted_pictures_)
      if (number >= enough) {
        ++score_.movers;
        score_.movers_found += found_ids_.contains(id) ? 1 : 0;
      }
    for (const auto& [track, counts] : tracks_)
      score_.false_tracks += counts.second >= 2 && counts.second > 2 * counts.first ? 1 : 0;
    const double minutes = pictures * labels_.step / labels_.pictures_per_s / 60;
    score_.false_tracks_per_min = minutes > 0 ? score_.false_tracks / minutes : 0;
  }

  const clip_labels& labels_;
  const clip_detections& found_;
  double scale_;
  counted_movers counts_;
  clip_score score_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  std::map<std::uint32_t, std::pair<int, int>> tracks_; // pictures in which it covered a mover, and none
  std::map<std::string, int> counted_pictures_;
  std::set<std::string> found_ids_;
};

} // namespace

tl::expected<clip_labels, std::string> parse_clip_labels(const std::string& json) {
  try {
    const auto all = nlohmann::json::parse(json);
    clip_labels result;
    result.pictures_per_s = all.at("fps").get<double>();
    result.step = all.value("step", 1);
    result.warm = all.value("warm", 10);
    result.overlap = all.value("iou", default_overlap);
    for (const auto& [number, picture] : all.at("frames").items()) {
      auto& to = result.pictures[std::stoi(number)];
      for (const auto& each : picture.at("movers"))
        to.movers.push_back({each.at(0).get<std::string>(), box_at(each, 1)});
      for (const auto& each : picture.at("ignore"))
        to.ignored.push_back(box_at(each, each.at(0).is_string() ? 1 : 0));
    }
    if (!(result.pictures_per_s > 0) || result.step < 1)
      return tl::make_unexpected("fps and step must be above zero");
    return result;
  } catch (const std::exception& wrong) {
    return tl::make_unexpected(std::string("no labels: ") + wrong.what());
  }
}

clip_score score_of(const clip_labels& labels, const std::vector<cv::Matx33d>& ground, const clip_detections& found) {
  return scoring(labels, ground, found).run();
}

} // namespace godwit::eyes::test
