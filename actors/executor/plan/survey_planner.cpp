// The lines of a survey, and its camera; see item_planner.hpp.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/item_planner.hpp"
#include "actors/executor/plan/line_rest.hpp"
#include "actors/executor/plan/mission_look.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/survey/survey_lines.hpp"
#include "actors/executor/plan/vehicle_items.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor::plan {

namespace {

struct line_form {
  std::uint16_t items; // of the vehicle
  std::uint16_t after; // of those, after the end of the line
};

line_form form_of(const mission::survey& item) {
  if (!item.camera)
    return {2, 0};
  return item.camera->turnaround_m > 0 ? line_form{6, 2} : line_form{4, 1};
}

mission::command_item camera_command(io::mavlink::mav_cmd command, double p1, double p2, double p3) {
  constexpr std::uint8_t no_position = 2;
  return {"", io::mavlink::number(command), no_position, {p1, p2, p3, 0, 0, 0, 0}, true};
}

// The first picture at once.
mission::command_item camera_on(const mission::survey_camera& camera) {
  using io::mavlink::mav_cmd;
  return camera.trigger.distance_m
             ? camera_command(mav_cmd::do_set_cam_trigg_dist, *camera.trigger.distance_m, 0, 1)
             : camera_command(mav_cmd::image_start_capture, 0, camera.trigger.interval_s.value_or(0), 0);
}

// By distance one more is taken at the end of the line, as ground stations have it.
mission::command_item camera_off(const mission::survey_camera& camera) {
  using io::mavlink::mav_cmd;
  return camera.trigger.distance_m ? camera_command(mav_cmd::do_set_cam_trigg_dist, 0, 0, 1)
                                   : camera_command(mav_cmd::image_stop_capture, 0, 0, 0);
}

// Rates are left to the gimbal.
mission::command_item gimbal_pitch(double pitch_deg) {
  auto result = camera_command(io::mavlink::mav_cmd::do_gimbal_manager_pitchyaw, pitch_deg, 0, 0);
  result.params[2] = result.params[3] = std::nullopt;
  return result;
}

// What is wrong with a survey, and what helps.
std::pair<std::string, std::string> words_for(plan_errc code) {
  if (code == plan_errc::area_too_large)
    return {"Its area reaches farther than " + std::to_string(std::lround(max_survey_radius_m / 1000)) + " km",
            "divide it"};
  if (code == plan_errc::too_many_lines)
    return {"Its area would take more than " + std::to_string(max_survey_lines) + " lines",
            "put the lines farther apart, or divide the area"};
  return {"Not even a short line lies in its area", "make the area larger"};
}

} // namespace

item_planner::outcome item_planner::plan(const mission::survey& item) {
  if (auto problem = why_not_flown())
    return problem;
  auto lines = survey_lines(item, point_of(place_before(mission_, index_)));
  if (!lines) {
    auto [what, remedy] = words_for(lines.error());
    return error(lines.error(), std::move(what), std::move(remedy));
  }
  if (lines_before_ >= lines->size())
    return std::nullopt;
  const auto form = form_of(item);
  if (item.camera && item.camera->gimbal_pitch_deg)
    writer_.repeat(command_item_of(gimbal_pitch(*item.camera->gimbal_pitch_deg), setting_));
  writer_.begin_survey(lines_before_, form.items, form.after);
  const auto first = lines->begin() + lines_before_;
  if (const auto* const begun = line_of_item(); begun != nullptr && item.camera) {
    if (const auto done_m = way_along(first->from, first->to, point_of(begun->at)))
      first->from = geo::destination(first->from, geo::bearing_deg(first->from, first->to), *done_m);
    writer_.continue_line(begun->pictures);
  }
  for (auto line = first; line != lines->end(); ++line)
    if (auto problem = fly_line(item, *line))
      return problem;
  writer_.end_survey();
  return std::nullopt;
}

// A command after a place is executed when the vehicle is there.
item_planner::outcome item_planner::fly_line(const mission::survey& item, const survey_line& line) {
  constexpr double accept_radius_m = 2; // a PX4's own, 10 m, would begin the pictures before the line
  const auto& camera = item.camera;
  const bool is_exact = camera && !is(vehicle_class::fixed_wing);
  const auto go_to = [&](const geo::point& at) -> outcome {
    const mission::position place{at.latitude_deg, at.longitude_deg, item.altitude_m};
    if (auto problem = why_not_there(place))
      return problem;
    writer_.cruise_to(place);
    writer_.add_nav(waypoint_item(place, 0, is_exact ? accept_radius_m : 0, setting_));
    return std::nullopt;
  };
  const double turn_m = camera ? camera->turnaround_m : 0;
  const double bearing_deg = turn_m > 0 ? geo::bearing_deg(line.from, line.to) : 0;
  if (turn_m > 0)
    if (auto problem = go_to(geo::destination(line.from, bearing_deg + 180, turn_m)))
      return problem;
  if (auto problem = go_to(line.from))
    return problem;
  if (camera)
    writer_.repeat(command_item_of(camera_on(*camera), setting_));
  if (auto problem = go_to(line.to))
    return problem;
  if (camera)
    writer_.repeat(command_item_of(camera_off(*camera), setting_));
  return turn_m > 0 ? go_to(geo::destination(line.to, bearing_deg, turn_m)) : std::nullopt;
}

} // namespace godwit::executor::plan
