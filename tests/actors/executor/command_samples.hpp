// Missions with one item of each command of the table, and what a vehicle has to report of them. Thread: one.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "actors/domain/mission/commands/item_class.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor::command_samples {

using mission::command_class;
using mission::command_item;
using mission::item_answer;
using mission::progress_kind;
using mission::vehicle_profile;
using sim::personality;
using tests::flight_world;

struct vehicle_row {
  personality who;
  vehicle_profile profile; // by the table
  vehicle_profile planned; // as the executor knows it: an ArduPlane may take off vertically
};

inline constexpr vehicle_row vehicles[] = {
    {personality::px4, vehicle_profile::px4_multicopter, vehicle_profile::px4_multicopter},
    {personality::ardupilot, vehicle_profile::arducopter, vehicle_profile::arducopter},
    {personality::plane, vehicle_profile::arduplane, vehicle_profile::quadplane},
    {personality::ardurover, vehicle_profile::ardurover, vehicle_profile::ardurover}};

inline command_item act(const char* id, std::uint16_t number, double first = 1, double second = 0, double third = 0) {
  return {id, number, 2, {first, second, third, 0, 0, 0, 0}, true};
}

inline command_item at_place(const std::string& id, std::uint16_t number, const mission::item& where) {
  const auto& at = std::get<mission::waypoint>(where).at;
  return {id, number, 3, {0, 0, 0, 0, at.latitude, at.longitude, at.altitude_m}, true};
}

inline mission::document mission_with(personality who, std::size_t place, std::vector<mission::item> more) {
  auto result = tests::short_mission(who);
  result.schema_version = mission::schema_version_2;
  const auto at = result.items.begin() + static_cast<std::ptrdiff_t>(std::min(place, result.items.size()));
  result.items.insert(at, more.begin(), more.end());
  return result;
}

// The reports of items are about each once in a generation, and their kinds are what the vehicle makes of them.
inline testing::AssertionResult tells_the_truth(const flight_world& world, const mission::document& mission,
                                                const std::map<std::string, progress_kind>& wanted) {
  std::map<std::string, progress_kind> ends;
  std::set<std::pair<std::uint32_t, std::string>> told;
  for (const auto& each : world.reports()) {
    if (!each.item_id || each.kind == progress_kind::started)
      continue;
    if (!told.emplace(each.generation, *each.item_id).second)
      return testing::AssertionFailure() << *each.item_id << " ends twice\n" << world.story();
    ends[*each.item_id] = each.kind;
  }
  for (const auto& each : mission.items) {
    const auto& id = mission::id_of(each);
    const auto expected = wanted.contains(id) ? wanted.at(id) : progress_kind::reached;
    if (!ends.contains(id) || ends.at(id) != expected)
      return testing::AssertionFailure() << id << " is " << (ends.contains(id) ? io::name_of(ends.at(id)) : "not told")
                                         << " and not " << io::name_of(expected) << "\n"
                                         << world.story();
  }
  if (world.reports().back().kind != progress_kind::complete)
    return testing::AssertionFailure() << "not complete\n" << world.story();
  return testing::AssertionSuccess();
}

// Numbers as a person would give them; a place of its own between w1 and w2.
inline command_item sample_of(const mission::command_row& row, personality who) {
  auto item = row.has_place ? at_place("x", row.id, tests::place(who, "", 60, 30)) : act("x", row.id, 1);
  switch (row.id) {
  case 18: // turns
    item.params[0] = 1;
    item.params[2] = 30;
    break;
  case 19: // seconds
  case 93:
  case 112:
    item.params[0] = 5;
    break;
  case 30:
    item.params[6] = 25;
    item.frame = 3;
    break;
  case 178:
    item.params = {1, 6, -1, 0, 0, 0, 0};
    break;
  default:
    break;
  }
  return item;
}

// It neither ends nor begins a flight, and somebody goes on after it.
inline bool is_flown_on_from(const mission::command_row& row) {
  constexpr std::uint16_t ends[] = {17, 20, 21, 22, 84, 85};
  const bool is_kind = row.kind == command_class::moves || row.kind == command_class::acts ||
                       row.kind == command_class::waits || row.kind == command_class::flow;
  return is_kind && std::ranges::find(ends, row.id) == std::end(ends) && row.id != 177 && row.id != 601;
}

inline std::vector<const mission::command_row*> rows_flown_on_from() {
  std::vector<const mission::command_row*> rows;
  for (unsigned id = 0; id <= 65'535; ++id)
    if (const auto* row = mission::command_of(static_cast<std::uint16_t>(id)); row != nullptr && is_flown_on_from(*row))
      rows.push_back(row);
  return rows;
}

// What becomes of an item of that command.
inline progress_kind end_of(const mission::command_row& row, const vehicle_row& vehicle) {
  if (row.answer_of(vehicle.planned) == item_answer::skipped)
    return progress_kind::skipped;
  return row.kind == command_class::moves && row.id != 3000 ? progress_kind::reached : progress_kind::passed;
}

} // namespace godwit::executor::command_samples
