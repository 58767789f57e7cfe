#include "programs/godwit-sim/camera_server/vehicle_camera.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <numbers>
#include <random>
#include <thread>
#include <utility>

#include <GeographicLib/LocalCartesian.hpp>

#include "programs/godwit-sim/camera/generator.hpp"
#include "programs/godwit-sim/camera_server/rtsp_server.hpp"

namespace godwit::sim {
namespace {

using clock = std::chrono::steady_clock;

constexpr double rad_in_deg = std::numbers::pi / 180;
constexpr double highest_m = 2'000; // the generator's ground has no end, its pictures have

// Walkers and vehicles, the seed draws where. They go in circles and so stay near.
std::vector<camera::mover> movers_of(const camera_place& where) {
  std::mt19937_64 draw(static_cast<std::uint64_t>(where.seed));
  const auto spread = static_cast<double>(where.spread_m);
  std::uniform_real_distribution<double> aside(-spread, spread);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  std::vector<camera::mover> result;
  for (std::int64_t i = 0; i < where.movers; ++i) {
    camera::mover each;
    each.id = static_cast<std::uint32_t>(i + 1);
    each.start = {static_cast<double>(where.north_m) + aside(draw), static_cast<double>(where.east_m) + aside(draw)};
    each.heading_rad = turn(draw);
    each.speed_m_s = 2.5;
    each.turn_rad_s = 0.15;
    each.brightness = i % 2 == 0 ? 235 : 25;
    result.push_back(each);
  }
  return result;
}

camera::scene_settings scene_of(const camera_place& where) {
  auto result = camera::tier_a(static_cast<std::uint64_t>(where.seed));
  result.style.contrast = 28; // a meadow in the sun: the ground gives hold
  result.style.roughness = 0.8;
  result.movers = movers_of(where);
  return result;
}

camera::lens lens_of(const camera_place& where) {
  return {static_cast<int>(where.width), static_cast<int>(where.height), static_cast<double>(where.focal_px), 0};
}

} // namespace

struct vehicle_camera::parts {
  parts(const camera_place& place, const position& home, looker ask)
      : where(place), look(std::move(ask)), local(home.latitude_deg, home.longitude_deg, home.altitude_m),
        maker(scene_of(place), lens_of(place)), home_at(home) {}

  void run() {
    const auto period = std::chrono::duration_cast<clock::duration>(
        std::chrono::duration<double>(1.0 / static_cast<double>(where.fps)));
    const auto began = clock::now();
    auto due = began;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        if (changed.wait_until(lock, due, [this] { return is_ending; }))
          return;
      }
      const auto now = clock::now();
      auto shot = maker.take(view_of(look(), std::chrono::duration<double>(now - began).count()));
      serving->push(shot.seen.grey);
      ++made;
      if (truth.is_open()) {
        camera::place_on_earth(shot.real, home_at.latitude_deg, home_at.longitude_deg);
        truth << camera::json_line(shot.real) << std::flush;
      }
      due = std::max(due + period, now);
    }
  }

  camera::camera_view view_of(const vehicle_picture& vehicle, double time_s) const {
    double east = 0;
    double north = 0;
    double up = 0;
    local.Forward(vehicle.where.latitude_deg, vehicle.where.longitude_deg, vehicle.where.altitude_m, east, north, up);
    camera::camera_view result;
    result.time_s = time_s;
    result.position = {north, east, -std::clamp(up, 1.0, highest_m)};
    result.attitude = camera::turned(camera::rotation_of(vehicle.heading_deg * rad_in_deg, 0, 0),
                                     // Camera axes: its x is the vehicle's right, its y the vehicle's tail.
                                     {vehicle.pitch_rad, -vehicle.roll_rad, 0});
    return result;
  }

  const camera_place where;
  const looker look;
  const GeographicLib::LocalCartesian local;
  const camera::generator maker;
  const position home_at;
  std::unique_ptr<rtsp_server> serving;
  std::ofstream truth;
  std::atomic<std::uint64_t> made{0};
  std::mutex mutex;
  std::condition_variable changed;
  bool is_ending = false;
  std::thread thread;
};

vehicle_camera::vehicle_camera(std::unique_ptr<parts> made) : parts_(std::move(made)) {}

tl::expected<std::unique_ptr<vehicle_camera>, std::string>
vehicle_camera::open(const camera_place& where, const position& home, const std::string& truth_file, looker look) {
  auto made = std::make_unique<parts>(where, home, std::move(look));
  auto serving = rtsp_server::open(where);
  if (!serving)
    return tl::make_unexpected(std::move(serving.error()));
  made->serving = *std::move(serving);
  if (!truth_file.empty()) {
    made->truth.open(truth_file);
    if (!made->truth.is_open())
      return tl::make_unexpected(truth_file + " can not be written");
  }
  std::unique_ptr<vehicle_camera> result(new vehicle_camera(std::move(made)));
  result->parts_->thread = std::thread([all = result->parts_.get()] { all->run(); });
  return result;
}

vehicle_camera::~vehicle_camera() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_ending = true;
  }
  parts_->changed.notify_all();
  if (parts_->thread.joinable())
    parts_->thread.join();
}

void vehicle_camera::set_cut(bool is_cut) { parts_->serving->set_cut(is_cut); }

std::uint64_t vehicle_camera::pictures() const { return parts_->made; }

std::uint16_t vehicle_camera::port() const { return parts_->serving->port(); }

} // namespace godwit::sim
