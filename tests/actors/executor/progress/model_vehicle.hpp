// A vehicle that flies plans item by item, and a line to it that loses, repeats and delays what it says. It knows what
// it has really flown.
//
// PX4-like: goes on with a new plan by itself, repeats MISSION_ITEM_REACHED, sends it before or after the next
// MISSION_CURRENT, and just after a switch tells old news; a set-current to the item where it has completed the mission
// changes nothing for it, unless it was held. The others stop at an upload and say REACHED once. A plan with the
// content that they have changes nothing for a PX4, and for another one that flies it and keeps ids. Thread: one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/executor/progress/events.hpp"
#include "tests/actors/executor/progress/progress_fixture.hpp"
#include "tests/support/test_rng.hpp"

namespace godwit::executor::progress::test {

inline constexpr std::int64_t ms = 1'000'000;
// Old news and a message under way together come within settling_ns.
inline constexpr int max_delay_ms = 900;

struct line_faults {
  int one_lost_in = 0; // 0: none
  int one_repeated_in = 0;
  int one_late_in = 0;
};

struct model_plan {
  plan_map map;
  std::uint32_t id = 0; // 0: none
  std::int32_t revision = 1;
  bool is_foreign = false; // uploaded by somebody else
};

// What it flew from one switch, jump or restart to the next.
struct model_run {
  std::size_t plan = 0;        // its place in the list of plans
  std::vector<bool> was_flown; // for each item of the map
  bool is_foreign = false;
  bool is_same_content = false; // as in the run before
};

// What came over the line.
struct heard {
  event what;
  std::size_t run = 0;  // in which it was said
  bool is_true = false; // as it is, and no old news
};

class model_vehicle {
public:
  model_vehicle(const flavour& which, tests::test_rng& draw) : kind_(which), draw_(draw) {}

  void set_faults(const line_faults& faults) { faults_ = faults; }
  void set_longest_leg_ms(int longest) { longest_leg_ms_ = longest; }
  void tick(std::int64_t now_ns);
  // What has come over the line by now.
  std::vector<heard> take_due();
  void cut_line() { line_.clear(); }

  void hold();
  void load(const model_plan& plan, std::size_t number);
  // What it flies from now on is a run of its own.
  void mark_run();
  // The same content again.
  void keep(const model_plan& plan, std::size_t number);
  void jump(std::uint16_t sequence);
  void reboot();

  [[nodiscard]] bool is_active() const { return is_active_; }
  [[nodiscard]] const model_plan* plan() const { return plan_ ? &*plan_ : nullptr; }
  [[nodiscard]] std::uint16_t sequence() const { return sequence_; }
  [[nodiscard]] std::size_t run() const { return runs_.size() - 1; } // the newest
  // In that run or a later one of the same plan or the same content.
  [[nodiscard]] bool has_flown(std::size_t since_run, std::uint32_t position) const;
  // In a later run than that.
  [[nodiscard]] bool has_had_foreign_plan(std::size_t since_run) const;

private:
  struct under_way {
    std::int64_t due_ns = 0;
    heard message;
  };

  [[nodiscard]] bool moves(std::uint16_t sequence) const;
  [[nodiscard]] mission_current now_says() const;
  void begin_run(std::size_t plan);
  void mark(std::uint16_t sequence);
  void pass_commands();
  void reach();
  void tell_stale_messages(const mission_current& before, std::optional<std::uint16_t> reached_before);
  void say_current();
  void send(const event& what, int delay_ms = 0, bool is_true = false);

  flavour kind_;
  tests::test_rng& draw_;
  line_faults faults_;
  int longest_leg_ms_ = 3000;
  std::int64_t now_ns_ = 0;
  std::optional<model_plan> plan_;
  std::uint16_t sequence_ = 0;
  bool is_active_ = false;
  bool is_complete_ = false;
  bool is_held_ = true;
  std::optional<std::uint16_t> last_reached_;
  std::int64_t reaches_at_ns_ = 0;
  std::int64_t next_current_ns_ = 0;
  std::int64_t next_repetition_ns_ = 0;
  std::optional<mission_current> says_still_; // the ids come late
  std::int64_t says_until_ns_ = 0;
  std::vector<model_run> runs_{{}};
  std::vector<under_way> line_;
};

} // namespace godwit::executor::progress::test
