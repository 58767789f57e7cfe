// What the camera shows, for operators: the newest picture as JPEG.
//
//   GET /api/v1/camera/picture            the newest, or 503 with the reason
//   GET /api/v1/camera/picture?after=N    the newest with a number above N, or 204 when there is none yet
//
//   GET /api/v1/points/N/picture          what the camera has shown of point of interest N, or 404
//
// With it come Godwit-Picture (its number), Godwit-Captured-Ms (since 1970, UTC) and Godwit-Age-Ms. Pictures are made
// only while somebody asks: the first may be refused with 503, and is there half a second later. Whoever may look at
// the stream may look here, too. A picture of a point comes with Godwit-Captured-Ms and Godwit-Age-Ms alone. Each
// client has one request under way and nothing is queued, so a slow one gets fewer pictures and nobody waits for it.
// Thread: that of the context.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "io/eyes/picture_slot.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "programs/godwitd/sightings/point_pictures.hpp"
#include "runtime/clock.hpp"

namespace godwit::operator_port {

struct camera_parts {
  std::function<std::optional<io::eyes::picture>(std::uint64_t after)> newest;
  std::function<void(std::int64_t until_ns)> want; // pictures until then; quick
  std::function<std::optional<daemon::point_picture>(std::uint64_t point)> of_point;
  const runtime::time_source* time = nullptr;
};

class camera_api : public std::enable_shared_from_this<camera_api> {
public:
  static constexpr std::int64_t wanted_for_ns = 3'000'000'000; // after the last who asked
  static constexpr std::int64_t picture_gap_ms = 100;
  static constexpr std::int64_t counts_for_ns = 5'000'000'000; // an older picture is none

  explicit camera_api(camera_parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] route_list routes();

private:
  [[nodiscard]] server_response picture_for(const server_request& asked) const;
  [[nodiscard]] server_response picture_of_point(const server_request& asked) const;
  [[nodiscard]] server_response answer_with(const std::vector<std::byte>& jpeg, std::int64_t age_ns) const;

  camera_parts parts_;
};

} // namespace godwit::operator_port
