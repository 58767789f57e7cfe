// What the missions service has told of the flight's mission and its map, and what it is asked for again.
//
// A mission that was refused is asked for again each minute, a map whose pull failed after 30 s, then in growing pauses
// up to 5 minutes, until it is synced, a flight begins or an operator accepts the copy from before; an operator's
// `pull` asks at once. A mission that the service has deleted is not asked for again. Nothing is asked in flight. What
// is said is lost with a crash of either actor, and is repeated.
//
// Without a mission of its own the service is asked for the vehicle's next one, as soon as none is under way, and again
// each minute: mission_client knows whether it is asked already. What is over is named with it, so that no mission is
// begun again by itself. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "actors/executor/flight/flight_context.hpp"

namespace godwit::executor {

class service_view {
public:
  static constexpr std::int64_t begin_again_ns = 60'000'000'000;
  static constexpr std::int64_t first_pull_pause_ns = 30'000'000'000;
  static constexpr std::int64_t longest_pull_pause_ns = 300'000'000'000;

  explicit service_view(const flight_context& flight) : flight_(flight) {}

  // -- what it tells
  void on_mission(const mission_client::mission_loaded& m);
  void on_refused(const mission_client::mission_refused& m, instant now);
  void on_map(const mission_client::map_pulled& m);
  void on_status(const mission_client::service_status& m);
  // mission_client has forgotten what it was told last.
  void forget_told();

  // -- what is asked
  [[nodiscard]] bool wants_status() const;
  void ask_again(effects& out, instant now);
  // By an operator. The sentence says why there is nothing to ask for; empty: it is asked at once.
  [[nodiscard]] std::string pull();

  // -- what is known
  // That mission_client is to have loaded; empty: none, or it is asked for the next one.
  [[nodiscard]] std::string mission_under_way() const;
  [[nodiscard]] mission_client::pull_state map() const { return map_; }
  [[nodiscard]] const std::string& map_problem() const { return map_problem_; } // why the last pull failed
  [[nodiscard]] const std::string& refusal() const { return refusal_; }         // empty: it was not refused

private:
  [[nodiscard]] bool is_copy_accepted() const;
  [[nodiscard]] std::vector<std::string> over() const;
  void ask_for_next(effects& out, instant now, bool at_once);
  [[nodiscard]] std::int64_t pull_pause_ns() const;
  void ask_for_map(effects& out, instant now, bool at_once);

  const flight_context& flight_;
  mission_client::pull_state map_ = mission_client::pull_state::not_started;
  std::string map_problem_;
  std::string refusal_;
  bool may_begin_again_ = false;  // it was refused, and not for ever
  std::int64_t begin_at_ns_ = 0;  // monotonic
  std::int64_t pull_at_ns_ = 0;   // 0: nothing is planned
  std::int64_t failed_pulls_ = 0; // in a row
  bool is_told_of_copy_ = false;  // that it was accepted
  bool wants_pull_ = false;       // an operator does
  std::int64_t next_at_ns_ = 0;   // the next mission is asked for again; 0: at once
  std::vector<std::string> told_over_;
};

} // namespace godwit::executor
