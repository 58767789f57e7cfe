// The items of a vehicle or ground station, one after the other, to items of a mission. What a mission can not say is a
// loss, and the item is taken without it or left out, as the loss says.
//
//   NAV_TAKEOFF, NAV_VTOL_TAKEOFF    takeoff       the place must be home: a mission climbs where the vehicle stands
//   NAV_WAYPOINT, _SPLINE_WAYPOINT   waypoint      hold, acceptance radius
//   NAV_LOITER_TIME                  loiter        time, radius
//   DO_CHANGE_SPEED                  change_speed  air or ground speed; not climb, descent and throttle
//   NAV_LAND, NAV_VTOL_LAND          land          without a place: where the item before it was
//   NAV_RETURN_TO_LAUNCH             return        to the home of the vehicle, which is not the planned one
//
// Altitudes above home are ours; those above mean sea level are turned into them with the planned home position, as a
// loss, because the vehicle may start elsewhere; those above terrain are not taken. A yaw of 0 is "none given" unless
// the plan is for PX4, where it is north.
//
// Where the vehicle is known, what it ignores in an item is no loss (the pitch of a take-off without wings, the place
// of an ArduCopter's take-off, a yaw of ArduPilot's), and what it refuses or passes over is one. Thread: one owner.
// Source: MAVLink's common.xml; the table of commands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/convert/vehicle_item.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

struct import_context {
  std::optional<vertex> home;            // where a take-off is meant to be
  std::optional<double> home_altitude_m; // above mean sea level
  bool is_for_px4 = false;
  std::optional<vehicle_profile> vehicle{}; // absent: any
};

// A profile counts for more than what a file says of its firmware.
[[nodiscard]] import_context context_of(const std::optional<planned_home>& home, bool is_for_px4,
                                        std::optional<vehicle_profile> vehicle);

class item_importer {
public:
  item_importer(const import_context& context, loss_list& losses) : context_(context), losses_(losses) {}

  void take(const vehicle_item& each);

  // What some pattern of a ground station comes to; gets an id.
  void append(item each, source_place where);

  [[nodiscard]] std::vector<item>& items() { return items_; }
  // Where each of them stands.
  [[nodiscard]] std::vector<source_place>& places() { return places_; }

private:
  void take_takeoff(const vehicle_item& each);
  void take_waypoint(const vehicle_item& each);
  void take_loiter(const vehicle_item& each);
  void take_land(const vehicle_item& each);
  void take_speed(const vehicle_item& each);

  void append(const vehicle_item& from, item each);
  void lose(const vehicle_item& each, const std::string& what, std::string why, std::string instead);
  // Parameter FROM_1 has to be 0 or not given, else it is a loss.
  void expect_none(const vehicle_item& each, std::size_t from_1, const std::string& what, std::string why);
  void expect_no_yaw(const vehicle_item& each);
  // False: the item is left out; the loss is noted.
  [[nodiscard]] bool is_executed(const vehicle_item& each);
  [[nodiscard]] bool is_infinite(const vehicle_item& each);
  [[nodiscard]] bool may_have_wings() const { return !context_.vehicle || has_wings(*context_.vehicle); }
  [[nodiscard]] bool is(vehicle_profile one) const { return context_.vehicle == one; }
  [[nodiscard]] bool is_for_ardupilot() const { return context_.vehicle && !is_px4(*context_.vehicle); }
  // Nothing when the item has to be left out; the loss is noted.
  [[nodiscard]] std::optional<double> height_of(const vehicle_item& each);
  [[nodiscard]] std::optional<position> place_of(const vehicle_item& each);

  import_context context_;
  loss_list& losses_;
  std::vector<item> items_;
  std::vector<source_place> places_;
  std::optional<vertex> last_place_;
};

} // namespace godwit::mission
