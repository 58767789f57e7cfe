// The plans that a vehicle holds, one of each type, and the one that is being uploaded.
//
// An atomic vehicle keeps the old plan until the new one is complete. One that is not replaces it item by item: from
// begin() on it holds the beginning of the new plan and the rest of the old one; its fence alone, which it judges as a
// whole, is kept until then too. The id of a plan is a checksum of what it says, so the same plan has the same id
// wherever it comes from; 0 means no plan, or a vehicle without ids.
// Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "actors/ground_port/mission_server/server_profile.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::ground_port::mission_server {

// A mission, a fence, rally points.
inline constexpr std::size_t plan_types = 3;

// The number of one of the three, and not of all of them or of none.
[[nodiscard]] constexpr bool is_one_type(std::uint8_t type) { return type < plan_types; }

struct held_plan {
  std::vector<mavlink::mission_item_int> items; // as the vehicle keeps them, without address
  std::uint32_t id = 0;
};

using mavlink::checksum_of; // of the items as they are kept

class plan_store {
public:
  explicit plan_store(const server_profile& vehicle) : vehicle_(vehicle) {}

  // TYPE is one of the three.
  [[nodiscard]] const held_plan& plan(mavlink::mav_mission_type type) const;

  // Does an upload of TYPE leave what is held alone until it is complete?
  [[nodiscard]] bool is_staged(mavlink::mav_mission_type type) const;

  void begin(mavlink::mav_mission_type type, int count);
  void begin_in_part(mavlink::mav_mission_type type);
  void put(const mavlink::mission_item_int& item); // after the one before, or in place of one that is there
  // True: the new plan says the same as the one before.
  bool complete();
  void discard(); // what came so far; where it has replaced something, that stays
  void clear(mavlink::mav_mission_type type);
  // As it was held before; the same plan has the same id.
  void restore(mavlink::mav_mission_type type, std::vector<mavlink::mission_item_int> items);

  // From now on; of a vehicle that keeps its home as item 0 of a mission.
  void set_home(const mavlink::mission_item_int& home);

  // The plan that was begun, as far as it is there.
  [[nodiscard]] const std::vector<mavlink::mission_item_int>& incoming() const;

private:
  [[nodiscard]] held_plan& place(mavlink::mav_mission_type type);
  [[nodiscard]] std::uint32_t id_of(const std::vector<mavlink::mission_item_int>& items) const;

  server_profile vehicle_;
  std::array<held_plan, plan_types> plans_;
  mavlink::mav_mission_type type_{}; // of the plan that was begun
  std::vector<mavlink::mission_item_int> staged_;
};

} // namespace godwit::ground_port::mission_server
