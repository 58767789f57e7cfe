#include "programs/godwitd/sightings/point_pictures.hpp"

#include <algorithm>

namespace godwit::daemon {

void point_pictures::add(const std::string& sighting_id, io::eyes::cutout picture) {
  const std::lock_guard guard(mutex_);
  waiting_.emplace_back(sighting_id, std::move(picture));
  if (waiting_.size() > max_waiting)
    waiting_.pop_front();
}

void point_pictures::belongs(const std::string& sighting_id, std::uint64_t point) {
  const std::lock_guard guard(mutex_);
  const auto found = std::ranges::find(waiting_, sighting_id, &std::pair<std::string, io::eyes::cutout>::first);
  if (found == waiting_.end())
    return;
  const auto known = points_.find(point);
  if (known == points_.end() || known->second.captured_ns <= found->second.captured_ns)
    points_[point] = std::move(found->second);
  waiting_.erase(found);
  if (points_.size() > max_points)
    points_.erase(points_.begin());
}

std::optional<io::eyes::cutout> point_pictures::of(std::uint64_t point) const {
  const std::lock_guard guard(mutex_);
  const auto found = points_.find(point);
  return found == points_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::uint64_t> point_pictures::points() const {
  const std::lock_guard guard(mutex_);
  std::vector<std::uint64_t> result;
  for (const auto& [point, picture] : points_)
    result.push_back(point);
  return result;
}

} // namespace godwit::daemon
