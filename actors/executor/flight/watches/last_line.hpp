// The fences of the mission and the rally points of its station on the vehicle itself: its last line, where neither
// godwit nor a person acts.
//
//   ready, disarmed ──> fence: upload, read back ──> rally points: the same ──> the rest goes on
//   no mission any more: what godwit has brought is cleared
//
// It stands after the plan and before the start, and nothing about it is in the way of a mission: what the vehicle
// refuses or does not answer within a few seconds is a warning. What somebody else has put there is replaced where the
// mission has its own, and else left alone. Only a vehicle that stands disarmed, and that godwit has, is brought
// anything: one outside of its new fence acts at once. Which rally points: those of a station whose plan is the
// mission. godwit sets no parameters, and says which one decides what comes of a breach. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "actors/executor/flight/flight_context.hpp"
#include "actors/executor/flight/stations/plan_clearing.hpp"

namespace godwit::executor {

// Numbers of its own, above those of clears.
inline constexpr std::uint64_t first_of_last_line = 1ULL << 34U;
// Altogether; and as long as somebody waits for a start.
inline constexpr std::int64_t last_line_within_ns = 8'000'000'000;
inline constexpr std::int64_t last_line_before_start_ns = 1'500'000'000;
inline constexpr std::int64_t last_line_again_after_ns = 300'000'000; // what was not begun

class last_line {
public:
  last_line(flight_context& flight, const plan_clearing& clearing) : flight_(flight), clearing_(clearing) {}

  // True: it is under way, and the rest waits.
  [[nodiscard]] bool advance(effects& out, instant now);
  // Something else needs the line to the vehicle.
  [[nodiscard]] effects stop();
  [[nodiscard]] bool awaits(std::uint64_t number) const { return doing_ && number == last_number_ && is_asked_; }
  // The vehicle still stands as it has to.
  [[nodiscard]] bool may_go_out() const { return stands(); }
  void on_transfer(effects& out, std::uint64_t number, const vehicle_link::transfer::outcome& outcome, instant now);

private:
  using items = std::vector<io::mavlink::mission_item_int>;
  struct part {
    io::mavlink::mav_mission_type type{};
    items wanted; // none: it is cleared
  };
  // What it is for: generation, is there a mission, is a fence or a rally point of a station kept.
  using occasion = std::tuple<std::uint32_t, bool, bool, bool>;

  [[nodiscard]] bool stands() const;
  [[nodiscard]] bool is_moment() const;
  [[nodiscard]] occasion occasion_now() const;
  void prepare(effects& out);
  void add(io::mavlink::mav_mission_type type, items wanted, bool was_brought);
  void begin_next(effects& out, instant now);
  void ask(effects& out, instant now);
  void take_read_back(effects& out, const items& theirs);
  void warn(effects& out, const std::string& why);
  void give_up(effects& out, const std::string& why);
  void say_brought(effects& out) const;
  void say_outdated(effects& out);
  void note_brought(effects& out, io::mavlink::mav_mission_type type, bool is_brought);

  flight_context& flight_;
  const plan_clearing& clearing_;
  std::deque<part> waiting_;
  std::optional<part> doing_;
  bool is_asked_ = false; // an order is out; else it is asked for again
  bool reads_back_ = false;
  std::int64_t until_ns_ = 0;
  std::int64_t again_ns_ = 0;
  bool is_start_waiting_ = false;
  std::optional<occasion> settled_;
  std::optional<std::vector<mission::geofence>> brought_; // by this incarnation
  std::uint32_t told_outdated_ = 0;                       // generation
  std::uint64_t last_number_ = first_of_last_line;
};

} // namespace godwit::executor
