// The camera of a simulated vehicle: looks straight down from it at a scene with movers, and serves what it sees.
//
//   vehicle ──where it is, each picture──> generator ──> rtsp_server
//
// A thread of its own makes the pictures; one that takes longer than its time makes the next one late, and none waits.
// The scene's origin is home. Errors: open, as a sentence. Thread: any.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "programs/godwit-sim/camera_server/camera_place.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::sim {

class vehicle_camera {
public:
  // Called in the camera's thread.
  using looker = std::function<vehicle_picture()>;

  // TRUTH_FILE: gets what is really to be seen, a line of JSON for each picture; empty: nobody wants it.
  [[nodiscard]] static tl::expected<std::unique_ptr<vehicle_camera>, std::string>
  open(const camera_place& where, const position& home, const std::string& truth_file, looker look);
  ~vehicle_camera();
  vehicle_camera(const vehicle_camera&) = delete;
  vehicle_camera& operator=(const vehicle_camera&) = delete;

  void set_cut(bool is_cut);
  [[nodiscard]] std::uint64_t pictures() const;
  [[nodiscard]] std::uint16_t port() const;

private:
  struct parts;
  explicit vehicle_camera(std::unique_ptr<parts> made);
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::sim
