#include "actors/ground_port/command_reading.hpp"

#include <cmath>

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

command said_by(const order& what, operators::command_kind which) {
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
    return said_by(what, command_kind::pause);
  if (what.param1 == to_continue)
    return said_by(what, command_kind::resume);
  return refused(mav_result::denied, what, "neither 0 nor 1 was asked for");
}

reading read_reposition(const order& what, std::optional<double> home_altitude_m) {
  if (!what.is_in_integers)
    return refused(mav_result::command_int_only, what, "it is taken as COMMAND_INT");
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
  if (is_above_sea && !home_altitude_m)
    return refused(mav_result::temporarily_rejected, what, "home's altitude is not known yet");
  auto result = said_by(what, command_kind::go_to);
  result.place = mission::position{what.x, what.y, what.z - (is_above_sea ? *home_altitude_m : 0.0)};
  return result;
}

} // namespace

tl::expected<command, word_refusal> read_word(const order& what, std::optional<double> home_altitude_m) {
  return what.command == mavlink::number(mav_cmd::do_reposition) ? read_reposition(what, home_altitude_m)
                                                                 : read_pause_or_continue(what);
}

std::string name_for_people(const order& what) {
  if (what.command == mavlink::number(mav_cmd::do_reposition))
    return "Go to";
  return what.param1 == to_continue ? "Continue" : "Pause";
}

} // namespace godwit::ground_port
