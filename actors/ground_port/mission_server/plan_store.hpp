// The plans that a vehicle holds, one of each type, and the one that is being uploaded.
//
// An atomic vehicle keeps the old plan until the new one is complete. One that is not replaces it item by item: from
// begin() on it holds the beginning of the new plan and the rest of the old one. The id of a plan is a checksum of what
// it says, so the same plan has the same id wherever it comes from; 0 means no plan, or a vehicle without ids.
// Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "actors/ground_port/mission_server/habits.hpp"

namespace godwit::ground_port::mission_server {

// A mission, a fence, rally points.
inline constexpr std::size_t plan_types = 3;

struct held_plan {
  std::vector<mavlink::mission_item_int> items; // as the vehicle keeps them, without address
  std::uint32_t id = 0;
};

// CRC-32 of the items as they are kept; never 0 for a plan with items.
[[nodiscard]] std::uint32_t checksum_of(const std::vector<mavlink::mission_item_int>& items);

class plan_store {
public:
  explicit plan_store(const habits& vehicle) : vehicle_(vehicle) {}

  // TYPE is one of the three.
  [[nodiscard]] const held_plan& plan(mavlink::mav_mission_type type) const;

  void begin(mavlink::mav_mission_type type, int count);
  void put(const mavlink::mission_item_int& item); // the next one of the plan that was begun
  void complete();
  void discard(); // what came so far; where it has replaced something, that stays
  void clear(mavlink::mav_mission_type type);

private:
  [[nodiscard]] held_plan& place(mavlink::mav_mission_type type);

  habits vehicle_;
  std::array<held_plan, plan_types> plans_;
  mavlink::mav_mission_type type_{}; // of the plan that was begun
  int count_ = 0;
  std::vector<mavlink::mission_item_int> incoming_;
};

} // namespace godwit::ground_port::mission_server
