#include "programs/godwit-sim/camera/truth.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <nlohmann/json.hpp>

namespace godwit::sim::camera {

void place_on_earth(truth& what, double origin_latitude_deg, double origin_longitude_deg) {
  const GeographicLib::LocalCartesian frame(origin_latitude_deg, origin_longitude_deg);
  for (auto& each : what.movers) {
    double height = 0;
    frame.Reverse(each.east_m, each.north_m, 0, each.latitude_deg, each.longitude_deg, height);
  }
}

std::string json_line(const truth& what) {
  auto movers = nlohmann::json::array();
  for (const auto& each : what.movers)
    movers.push_back({{"id", each.id},
                      {"kind", each.kind},
                      {"x_px", each.x_px},
                      {"y_px", each.y_px},
                      {"width_px", each.width_px},
                      {"height_px", each.height_px},
                      {"visible_share", each.visible_share},
                      {"is_cut", each.is_cut},
                      {"north_m", each.north_m},
                      {"east_m", each.east_m},
                      {"latitude_deg", each.latitude_deg},
                      {"longitude_deg", each.longitude_deg},
                      {"speed_m_s", each.speed_m_s},
                      {"speed_px_s", each.speed_px_s}});
  const auto q = quaternion_of(what.view.attitude);
  const auto& at = what.view.position;
  const nlohmann::json line{
      {"time_s", what.time_s},
      {"camera",
       {{"north_m", at.x}, {"east_m", at.y}, {"down_m", at.z}, {"attitude_wxyz", q}, {"zoom", what.view.zoom}}},
      {"movers", movers}};
  return line.dump() + "\n";
}

} // namespace godwit::sim::camera
