// A whole flight from one number: a mission, a model vehicle, an executor that uploads, starts, aborts, is assigned new
// items, crashes at any event and resolves what was under way, foreign hands, restarts of the vehicle; then calm, until
// the mission is complete. Each report is compared with what the vehicle has really flown.
//
//   model_flight flight(seed, px4);
//   flight.play();
//   EXPECT_EQ(flight.violation(), "") << flight.log();
//
// Thread: one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/actors/executor/progress/flight_judge.hpp"
#include "tests/actors/executor/progress/model_vehicle.hpp"

namespace godwit::executor::progress::test {

class model_flight {
public:
  model_flight(std::uint64_t seed, const flavour& which);

  // Before it is played: the log has each event too.
  void note_events() { notes_events_ = true; }
  void play();
  // Without faults and changes: each REACHED comes.
  void play_calmly();

  [[nodiscard]] const std::string& violation() const { return judge_.violation(); }
  [[nodiscard]] std::string log() const { return judge_.log(); }
  [[nodiscard]] const std::vector<mission::progress_report>& reports() const { return judge_.reports(); }
  [[nodiscard]] std::uint64_t events() const { return events_; }
  // ITEM is one that moves the vehicle.
  [[nodiscard]] bool moves(const std::string& item) const;

  static constexpr int chaos_turns = 80;
  static constexpr int one_event_in_crashes = 40;
  static constexpr int max_calm_turns = 400;
  static constexpr int patient_turns = 5; // a message that is under way has come by then
  static constexpr int ending_turns = 12; // what waits for a REACHED is resolved by then

private:
  struct model_item {
    std::string id;
    int commands_in_front = 0;
    int movements = 1; // 0: commands only, or nothing at all
  };
  enum class upload_phase { none, intended, switched, looked_at };
  enum class start_phase { none, intended, executed };

  // -- the executor -----------------------------------------------------------------------------------
  void turn_of_chaos();
  void turn(int ms_from, int ms_to);
  void finish_calmly();
  void act_as_needed();
  void act_at_random();
  void intend_new_plan(bool is_new_revision);
  void intend_same_plan();
  void intend_upload(plan_map map);
  void go_on_with_upload();
  void end_upload();
  void intend_start(std::uint32_t position);
  void go_on_with_start();
  void end_start();
  void crash();
  void let_foreign_hand_upload();
  void restart_vehicle();
  void answer(const effect& question);
  [[nodiscard]] bool needs_upload() const;
  [[nodiscard]] bool needs_start() const;
  [[nodiscard]] bool is_done() const;
  [[nodiscard]] std::uint32_t first_undone() const;                // in the mission
  [[nodiscard]] std::optional<std::uint32_t> first_to_fly() const; // in the plan
  [[nodiscard]] model_item new_item(bool must_move);
  [[nodiscard]] plan_map map_from(std::size_t first);
  [[nodiscard]] std::uint32_t id_of_content(const plan_map& map);

  // -- what it says -----------------------------------------------------------------------------------
  void hear(const heard& message);
  void take(const event& happened);
  void take_and_crash(const event& happened);
  void dispatch(const effects& all);
  void check_end();
  void note(const progress_event& what);
  void open_generation(std::uint32_t number);

  flavour kind_;
  tests::test_rng draw_;
  model_vehicle vehicle_;
  state s_;
  std::int64_t now_ns_ = 1'700'000'000'000'000'000;
  std::vector<model_item> items_;
  std::int32_t revision_ = 1;
  std::vector<model_plan> plans_; // each that was ever meant for the vehicle
  flight_judge judge_;
  int next_item_ = 0;
  std::uint32_t next_id_ = 1000;

  upload_phase upload_ = upload_phase::none;
  std::size_t upload_run_ = 0;
  std::int32_t upload_revision_ = 1;
  std::vector<model_item> items_before_; // if the upload of a new revision fails
  start_phase start_ = start_phase::none;
  std::size_t start_run_ = 0;
  bool is_start_refused_ = false;
  std::vector<effect> questions_;
  bool is_not_at_start_ = false;
  bool was_incomplete_ = false; // the mission, when MISSION_CURRENT was heard last
  std::optional<std::uint16_t> last_sequence_;
  int idle_turns_ = 0; // in a row, of the vehicle

  bool is_calm_ = true;
  std::uint64_t events_ = 0;
  std::uint64_t lost_ = 0; // events, in crashes
  bool notes_events_ = false;
};

} // namespace godwit::executor::progress::test
