// What the camera has shown of points of interest: a small JPEG of each, for people who decide about it and for the
// missions service.
//
//   movement_detector ──sighting, its cut-out──> add ──> waits ──number of its point──> belongs ──> a file ──> of
//                                                                                                    └──> next, noted
//
// Beside the messages, not in them: pictures are large, and nothing is decided by them. A file of the folder is one
// picture, named by what it is of, and NAME.new beside it stands until its delivery is noted elsewhere; so both survive
// the process. A newer picture of the same point takes the place of one that is new; the others are kept until there
// are max_files, of which the oldest goes. Errors: a disk that takes no picture is a picture less, and counted.
// Thread: any; a call writes, reads and removes one file of 24 KiB, but for the constructor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/eyes/picture_slot.hpp"
#include "messages/mission_client/types.hpp"

namespace godwit::daemon {

struct point_picture {
  std::int64_t captured_ns = 0; // since 1970 (UTC)
  std::vector<std::byte> jpeg;
};

// What a sighting has become.
struct sighted_point {
  std::uint64_t number = 0;
  std::string mission_id;
  std::int64_t at_ns = 0; // since 1970 (UTC)
};

class point_pictures {
public:
  static constexpr std::size_t max_waiting = 64; // sightings that are of no point yet; the oldest goes
  static constexpr std::size_t max_files = 256;  // 6 MiB

  // FOLDER is made with the first picture.
  explicit point_pictures(std::filesystem::path folder);

  void add(const std::string& sighting_id, io::eyes::cutout picture);
  // The sighting has become a part of this point. Of one without a picture nothing happens.
  void belongs(const std::string& sighting_id, const sighted_point& point);
  [[nodiscard]] std::optional<point_picture> of(std::uint64_t point) const; // the newest
  [[nodiscard]] std::vector<std::uint64_t> points() const;                  // that have one, the lowest first

  // The oldest whose delivery nobody has noted; and somebody has noted that of FILE.
  [[nodiscard]] std::optional<mission_client::deliver_picture> next() const;
  void noted(const std::string& file);
  [[nodiscard]] std::uint64_t lost() const; // that went before they were noted, or were not written

private:
  struct stored {
    std::int64_t captured_ns = 0;
    std::uint64_t point = 0;
    std::string mission_id;
    std::string sighting_id;
    bool is_new = true;

    [[nodiscard]] std::string file() const;
  };

  [[nodiscard]] static std::optional<stored> read_name(const std::string& name);
  [[nodiscard]] bool write(const stored& what, const std::vector<std::byte>& jpeg) const;
  void remove(std::size_t index);

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;                                     // over all that follows
  std::deque<std::pair<std::string, io::eyes::cutout>> waiting_; // oldest first
  std::vector<stored> files_;                                    // the same
  std::uint64_t lost_ = 0;
};

} // namespace godwit::daemon
