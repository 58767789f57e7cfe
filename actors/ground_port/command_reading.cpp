#include "actors/ground_port/command_reading.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/mavlink/frame_meaning.hpp"

namespace godwit::ground_port {

namespace {

using mavlink::altitude_kind;
using mavlink::mav_cmd;
using mavlink::mav_result;
using operators::command;
using operators::command_kind;
using reading = tl::expected<command, word_refusal>;
using vehicle_role::order;

constexpr float default_speed = -1.0F;
constexpr float to_pause = 0.0F;
constexpr float to_continue = 1.0F;

reading refused(mav_result result, const order& what, const std::string& why) {
  return tl::unexpected(word_refusal{result, name_for_people(what) + ": " + why});
}

bool is_left_open(float value, float open) { return std::isnan(value) || value == open; }

// The absent one, INT32_MAX, is beyond both bounds.
bool is_on_earth(const order& what) {
  constexpr double most_latitude = 90;
  constexpr double most_longitude = 180;
  return std::abs(what.x) <= most_latitude && std::abs(what.y) <= most_longitude;
}

std::string name_of(mavlink::sender who) {
  return "station " + std::to_string(who.system) + '/' + std::to_string(who.component);
}

} // namespace

command command_from(const order& what, operators::command_kind which) {
  command result;
  result.kind = which;
  result.by = name_of(what.from);
  result.system = what.from.system;
  result.component = what.from.component;
  return result;
}

namespace {

reading read_pause_or_continue(const order& what) {
  if (what.param1 == to_pause)
    return command_from(what, command_kind::pause);
  if (what.param1 == to_continue)
    return command_from(what, command_kind::resume);
  return refused(mav_result::denied, what, "neither 0 nor 1 was asked for");
}

// A coordinate of COMMAND_INT that is INT32_MAX; its unit depends on the frame.
bool is_absent(double coordinate, const order& what) {
  if (!what.is_in_integers)
    return std::isnan(coordinate);
  const auto units = mavlink::units_of(mavlink::coordinates_of(what.frame).value_or(mavlink::coordinate_kind::local));
  return std::lround(coordinate * units) == std::numeric_limits<std::int32_t>::max();
}

bool has_no_place(const order& what) { return is_absent(what.x, what) && is_absent(what.y, what); }

bool is_at_its_altitude(const order& what, const told_by_vehicle& told) {
  constexpr double same_altitude_m = 1; // streams come four times a second
  const auto altitude =
      mavlink::altitude_in(what.is_in_integers ? what.frame : mavlink::number(mavlink::mav_frame::global));
  if (!told.here || !altitude || *altitude == altitude_kind::above_terrain)
    return false;
  const bool is_above_sea = *altitude == altitude_kind::above_sea;
  if (is_above_sea && !told.home_altitude_m)
    return false;
  const double wanted_m = what.z - (is_above_sea ? *told.home_altitude_m : 0.0);
  const double then_m = told.held_from_m.value_or(told.here->altitude_m);
  return wanted_m > std::min(then_m, told.here->altitude_m) - same_altitude_m &&
         wanted_m < std::max(then_m, told.here->altitude_m) + same_altitude_m;
}

// What a PX4 keeps of itself.
std::optional<order> filled_up(order what, const told_by_vehicle& told) {
  const bool is_complete = !has_no_place(what) && !std::isnan(what.z);
  if (told.autopilot != mavlink::mav_autopilot::px4 || is_complete)
    return what;
  if (!told.here)
    return std::nullopt;
  if (has_no_place(what)) {
    what.x = told.here->latitude;
    what.y = told.here->longitude;
  }
  if (std::isnan(what.z)) {
    what.z = static_cast<float>(told.here->altitude_m);
    what.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
  }
  return what;
}

reading read_reposition(order what, const told_by_vehicle& told) {
  const bool is_px4 = told.autopilot == mavlink::mav_autopilot::px4;
  if (!what.is_in_integers && told.autopilot == mavlink::mav_autopilot::ardupilotmega)
    return refused(mav_result::unsupported, what, "it is taken as COMMAND_INT");
  if (!what.is_in_integers && !is_px4)
    return refused(mav_result::command_int_only, what, "it is taken as COMMAND_INT");
  if (is_pause_by_reposition(what, told))
    return command_from(what, command_kind::pause);
  if (!what.is_in_integers)
    what.frame = mavlink::number(mavlink::mav_frame::global);
  const auto complete = filled_up(what, told);
  if (!complete)
    return refused(mav_result::temporarily_rejected, what, "where the vehicle is, is not known");
  what = *complete;
  const auto altitude = mavlink::altitude_in(what.frame);
  if (!altitude || *altitude == altitude_kind::above_terrain)
    return refused(mav_result::unsupported_mav_frame, what, "frame " + std::to_string(what.frame) + " is not taken");
  if (!is_left_open(what.param1, default_speed))
    return refused(mav_result::denied, what, "the speed can not be changed by it");
  if (!is_left_open(what.param3, 0) || !is_left_open(what.param4, 0))
    return refused(mav_result::denied, what, "no radius and no yaw can be chosen");
  if (!is_on_earth(what))
    return refused(mav_result::denied, what, "this is no place on earth");
  if (!std::isfinite(what.z))
    return refused(mav_result::denied, what, "the altitude is no number");
  const bool is_above_sea = *altitude == altitude_kind::above_sea;
  if (is_above_sea && !told.home_altitude_m)
    return refused(mav_result::temporarily_rejected, what, "home's altitude is not known yet");
  auto result = command_from(what, command_kind::go_to);
  result.place = mission::position{what.x, what.y, what.z - (is_above_sea ? *told.home_altitude_m : 0.0)};
  return result;
}

} // namespace

tl::expected<command, word_refusal> read_word(const order& what, const told_by_vehicle& told) {
  return what.command == mavlink::number(mav_cmd::do_reposition) ? read_reposition(what, told)
                                                                 : read_pause_or_continue(what);
}

bool is_pause_by_reposition(const order& what, const told_by_vehicle& told) {
  if (told.autopilot != mavlink::mav_autopilot::px4 || !has_no_place(what))
    return false;
  return std::isnan(what.z) || is_at_its_altitude(what, told);
}

std::string name_for_people(const order& what) {
  if (what.command == mavlink::number(mav_cmd::do_reposition))
    return "Go to";
  const bool is_pause = what.command == mavlink::number(mav_cmd::do_pause_continue) && what.param1 != to_continue;
  return is_pause ? "Pause" : "Continue"; // by a mission mode, too
}

} // namespace godwit::ground_port
