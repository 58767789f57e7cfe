// What the camera has shown of points of interest: a small JPEG of each, for people who decide about it.
//
//   movement_detector ──sighting, its cut-out──> add ──> waits ──number of its point──> belongs ──> of
//
// Beside the messages, not in them: pictures are large, and nothing is decided by them. They are in memory alone and
// end with the process. A newer one of the same point takes its place. Thread: any; nothing blocks for longer than a
// copy of one.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/eyes/picture_slot.hpp"

namespace godwit::daemon {

class point_pictures {
public:
  static constexpr std::size_t max_waiting = 64; // sightings that are of no point yet; the oldest goes
  static constexpr std::size_t max_points = 128; // the one with the lowest number goes

  void add(const std::string& sighting_id, io::eyes::cutout picture);
  // The sighting has become a part of this point. Of one without a picture nothing happens.
  void belongs(const std::string& sighting_id, std::uint64_t point);
  [[nodiscard]] std::optional<io::eyes::cutout> of(std::uint64_t point) const;
  [[nodiscard]] std::vector<std::uint64_t> points() const; // that have one, the lowest first

private:
  mutable std::mutex mutex_;                                     // over all that follows
  std::deque<std::pair<std::string, io::eyes::cutout>> waiting_; // oldest first
  std::map<std::uint64_t, io::eyes::cutout> points_;
};

} // namespace godwit::daemon
