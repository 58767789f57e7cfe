// The items of a vehicle or ground station, one after the other, to items of a mission. What godwit can plan itself
// without changing the flight gets its kind; everything else goes into the mission as the command that it is.
//
//   NAV_TAKEOFF             takeoff       without a place, above home: no pitch, no yaw; not of a rover
//   NAV_WAYPOINT            waypoint      above home: hold, acceptance radius; no pass radius, no yaw
//   NAV_LOITER_TIME         loiter        above home: time, radius; of a multirotor
//   DO_CHANGE_SPEED         change_speed  ground speed, no throttle; of a multirotor
//   NAV_LAND                land          above home; of a multirotor; a PX4's without a place: at the item before it
//   NAV_RETURN_TO_LAUNCH    return        to the home of the vehicle, which is not the planned one
//   DO_JUMP                 jump          to the item with that number
//   all others              command       as it came
//
// An item gets its own kind only where the vehicle then gets, field by field, what the file has; what is not given may
// become 0, which means the same in those fields. "No yaw" is NaN, to a known ArduPilot also 0; to a PX4 0 is north.
// Wings circle where a multirotor waits, and a rover drives to where it lands, so theirs stay commands.
//
// Losses are what no mission may hold (command_policy.hpp), what the vehicle refuses, a place in a frame that vehicles
// do not take, and a jump to nowhere. Thread: one owner. Source: MAVLink's common.xml; the table of commands.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/convert/vehicle_item.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

struct import_context {
  bool is_for_px4 = false;
  std::optional<vehicle_profile> vehicle{}; // absent: any
  allowed_commands allowed{};
};

// A profile counts for more than what a file says of its firmware.
[[nodiscard]] import_context context_of(bool is_for_px4, std::optional<vehicle_profile> vehicle,
                                        const allowed_commands& allowed = {});

class item_importer {
public:
  item_importer(const import_context& context, loss_list& losses) : context_(context), losses_(losses) {}

  void take(const vehicle_item& each);
  // After the last one: where the jumps lead is known now. One that leads nowhere is left out.
  void resolve_jumps();

  // What some pattern of a ground station comes to; gets an id. NUMBER: its place in the source, from 0 on.
  void append(item each, source_place where, std::size_t number);

  [[nodiscard]] std::vector<item>& items() { return items_; }
  // Where each of them stands.
  [[nodiscard]] std::vector<source_place>& places() { return places_; }
  // For each of them: of the item in the source that it was made of.
  [[nodiscard]] const std::vector<std::size_t>& numbers() const { return numbers_; }

private:
  struct pending_jump {
    std::size_t index; // in items_
    vehicle_item from;
  };
  // The item that godwit plans itself; nothing: it would change the flight.
  [[nodiscard]] std::optional<item> planned_of(const vehicle_item& each) const;
  [[nodiscard]] std::optional<item> takeoff_of(const vehicle_item& each) const;
  [[nodiscard]] std::optional<item> waypoint_of(const vehicle_item& each) const;
  [[nodiscard]] std::optional<item> loiter_of(const vehicle_item& each) const;
  [[nodiscard]] std::optional<item> land_of(const vehicle_item& each) const;
  [[nodiscard]] std::optional<item> speed_of(const vehicle_item& each) const;
  void take_jump(const vehicle_item& each);
  void erase(std::size_t index);

  void append(const vehicle_item& from, item each);
  void lose(const vehicle_item& each, const std::string& what, std::string why, std::string instead);
  // False: the item is left out; the loss is noted.
  [[nodiscard]] bool may_be_carried(const vehicle_item& each);
  [[nodiscard]] bool has_yaw(const vehicle_item& each) const;
  [[nodiscard]] bool is_infinite(const vehicle_item& each);
  [[nodiscard]] bool is(vehicle_profile one) const { return context_.vehicle == one; }
  [[nodiscard]] bool is_for_multirotor() const {
    return is(vehicle_profile::arducopter) || is(vehicle_profile::px4_multicopter);
  }
  // ArduPilot waits for whole seconds.
  [[nodiscard]] bool waits_so_long(double seconds) const {
    return seconds == 0 || (is_for_multirotor() && (context_.is_for_px4 || seconds == std::trunc(seconds)));
  }
  [[nodiscard]] bool is_for_ardupilot() const { return context_.vehicle && !is_px4(*context_.vehicle); }

  import_context context_;
  loss_list& losses_;
  std::vector<item> items_;
  std::vector<source_place> places_;
  std::vector<std::size_t> numbers_;
  std::vector<std::size_t> jump_numbers_; // by which a DO_JUMP names each of them
  std::vector<pending_jump> jumps_;
  std::optional<vertex> last_place_;
};

} // namespace godwit::mission
