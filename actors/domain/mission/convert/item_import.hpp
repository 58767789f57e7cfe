// The items of a vehicle or ground station, one after the other, to items of a mission. What godwit can plan itself
// without changing the flight gets its kind; everything else goes into the mission as the command that it is.
//
//   NAV_TAKEOFF             takeoff       straight up, above home: no pitch, yaw or place elsewhere
//   NAV_WAYPOINT            waypoint      above home: hold, acceptance radius; no pass radius, no yaw
//   NAV_LOITER_TIME         loiter        above home: time, radius
//   DO_CHANGE_SPEED         change_speed  air or ground speed; not climb, descent and throttle
//   NAV_LAND                land          above home; without a place: where the item before it was
//   NAV_RETURN_TO_LAUNCH    return        to the home of the vehicle, which is not the planned one
//   DO_JUMP                 jump          to the item with that number
//   all others              command       as it came
//
// Losses are what no mission may hold (command_policy.hpp), what the vehicle refuses, a place in a frame that vehicles
// do not take, and a jump to nowhere. A yaw of 0 is "none given" unless the plan is for PX4, where it is north. Where
// the vehicle is known, what it ignores in an item is passed over: the pitch of a take-off without wings, the place of
// an ArduCopter's take-off, a yaw of ArduPilot's. Thread: one owner. Source: MAVLink's common.xml; the table of
// commands.
#pragma once

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
  std::optional<vertex> home; // where a take-off is meant to be
  bool is_for_px4 = false;
  std::optional<vehicle_profile> vehicle{}; // absent: any
  allowed_commands allowed{};
};

// A profile counts for more than what a file says of its firmware.
[[nodiscard]] import_context context_of(const std::optional<planned_home>& home, bool is_for_px4,
                                        std::optional<vehicle_profile> vehicle, const allowed_commands& allowed = {});

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
  [[nodiscard]] bool may_have_wings() const { return !context_.vehicle || has_wings(*context_.vehicle); }
  [[nodiscard]] bool is(vehicle_profile one) const { return context_.vehicle == one; }
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
