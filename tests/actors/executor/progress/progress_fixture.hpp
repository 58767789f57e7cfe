// The progress of one vehicle on a table: plans of items with one movement each, messages of the vehicle by the
// position of the item, and what was said, in short texts. Thread: one owner.
//
//   progress_fixture d(px4);
//   d.fly({"A", "B"});             // mission "m", uploaded, armed at A
//   d.wait_s(3);
//   d.reached(0);
//   EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1"}));
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "actors/executor/progress/core.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor::progress::test {

using texts = std::vector<std::string>;
using io::mavlink::mission_current;
using io::mavlink::mission_state;

struct flavour {
  std::string name;
  std::uint16_t first_sequence = 0;
  bool has_ids = false;
  bool goes_on = false; // with a new plan, by itself; and it repeats MISSION_ITEM_REACHED
  friend std::ostream& operator<<(std::ostream& out, const flavour& which) { return out << which.name; }
};

inline const flavour px4{"px4", 0, true, true};
inline const flavour ardupilot{"ardupilot", 1, false, false};
inline const flavour rover{"rover", 0, true, false}; // that keeps to the text of MAVLink

// Of the items IDS, one movement each, the first of them at INDEX of the mission.
[[nodiscard]] plan_map map_of(const flavour& vehicle, const texts& ids, std::uint32_t index = 0,
                              bool ends_mission = true);

class progress_fixture {
public:
  explicit progress_fixture(flavour which = px4);

  effects take(const event& happened);
  void wait_ms(std::int64_t ms) { now_ns += ms * 1'000'000; }
  void wait_s(std::int64_t seconds) { wait_ms(seconds * 1000); }
  // All that survives is what the state says of itself.
  void crash();

  // -- the executor ---------------------------------------------------------------------------------
  // At the next plan id.
  void intend(const plan_map& map, std::int32_t revision = 1, std::optional<assignment_key> assignment = {});
  void accept();
  void upload(const plan_map& map, std::int32_t revision = 1, std::optional<assignment_key> assignment = {});
  void upload(const texts& ids, std::uint32_t index = 0) { upload(map_of(vehicle, ids, index)); }
  // Uploaded, and seen at its first item, active.
  void fly(const texts& ids, std::uint32_t index = 0);
  void start_at(int position);
  void started(bool is_accepted = true) { take(start_ended{is_accepted}); }

  // -- the vehicle ----------------------------------------------------------------------------------
  // Of the plan that is on the vehicle.
  [[nodiscard]] mission_current current_message(int position, mission_state how = mission_state::active) const;
  void current(int position, mission_state how = mission_state::active) { say(current_message(position, how)); }
  void say(const mission_current& message) { take(current_told{message}); }
  void reached(int position) { take(reached_told{sequence(position)}); }
  [[nodiscard]] std::uint16_t sequence(int position) const;

  // -- what was said --------------------------------------------------------------------------------
  // "reached B#1 g2 inferred", since the last call.
  texts said();
  // "armed g2", since the last call.
  texts news_told();
  [[nodiscard]] bool is_armed() const { return s.plan && s.plan->generation.is_armed; }

  flavour vehicle;
  std::int64_t now_ns = 1'700'000'000'000'000'000;
  state s;
  std::uint32_t plan_id = 100; // on the vehicle
  std::uint16_t total = 0;     // on the vehicle
  std::vector<mission::progress_report> reports;
  std::vector<assignment_answered> answers;
  std::vector<progress_event> told;
  std::vector<effect> questions;

private:
  std::size_t said_ = 0;
  std::size_t told_ = 0;
  std::uint16_t next_total_ = 0;
};

[[nodiscard]] std::string text_of(const mission::progress_report& report);

} // namespace godwit::executor::progress::test
