// What a new incarnation of the executor does first, and how it resolves what the one before left open.
//
// It knows what it meant to do, and not what the vehicle does. So it looks before anything; on the ground nothing
// begins by itself; in flight what was meant is finished by a mode change, and only out of a hold that godwit has
// commanded and that this process has heard: after a restart of the process that hold may be a person's, and only a
// person's resume ends it. Uploads and starts without an answer are resolved by what the vehicle holds and says. Pure.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/executor/flight/watches/control_watch.hpp"

namespace godwit::executor {

// Downloads that resolve an upload have numbers of their own, above all those of the runner.
inline constexpr std::uint64_t first_reading_back = 1ULL << 32U;

class recovery {
public:
  recovery(flight_context& flight, phase_machine& phases, task_control& tasks, control_watch& watch)
      : flight_(flight), phases_(phases), tasks_(tasks), watch_(watch) {}

  void begin(bool is_new_process);
  // For so long the vehicle has been heard as this incarnation begins (vehicle_link::connection). Not told: not at all.
  void on_heard_for(std::int64_t ms, instant now);
  [[nodiscard]] bool has_looked() const { return has_looked_; }
  // True: the rest waits for it.
  [[nodiscard]] bool look(effects& out, instant now);
  [[nodiscard]] bool resolve(effects& out, instant now);
  // What was begun in flight and is meant to be finished.
  [[nodiscard]] bool finish(effects& out);

  // What the progress wants looked at.
  void on_news(const progress::look_at_vehicle&, instant now);
  void on_news(const progress::read_plan_back&, instant now);
  void on_news(const progress::resolve_start&, instant now);

  [[nodiscard]] bool awaits(std::uint64_t number) const { return number == reading_back_; }
  void take_read_back(effects& out, std::uint64_t number, const vehicle_link::transfer::outcome& outcome, instant now);

private:
  // What a restart or a lost answer left open about the vehicle.
  enum class question { none, plan_id, read_back, start };

  [[nodiscard]] bool was_taken_in_start() const;
  void recover_on_ground(effects& out, instant now);
  void recover_in_flight(effects& out, instant now);
  void find_in_flight(effects& out, const std::optional<task>& doing, instant now);
  void find_called_home(effects& out, instant now);
  void read_back(effects& out, instant now);
  void resolve_plan_id(effects& out, instant now, bool is_news);
  void resolve_start(effects& out, bool is_news);
  [[nodiscard]] std::optional<task> was_doing() const;
  // What the incarnation before has not seen the end of, and may be tried again.
  [[nodiscard]] bool tries_again() const;
  // An upload that was cut off has left items of both plans on a vehicle that replaces them one by one.
  [[nodiscard]] bool is_mixture(const std::vector<io::mavlink::mission_item_int>& items) const;
  // Where the vehicle may be, when nobody else has touched it since.
  [[nodiscard]] std::vector<std::uint32_t> left_in(const std::optional<task>& doing) const;
  // The order of the process before comes through when this one has seen the vehicle held.
  [[nodiscard]] bool follow_late_order(effects& out, instant now);
  void begin_at_start(effects& out);
  void begin_going_on(effects& out);

  flight_context& flight_;
  phase_machine& phases_;
  task_control& tasks_;
  control_watch& watch_;
  bool is_new_process_ = false;
  std::int64_t heard_until_ns_ = 0; // it was heard while nobody was here; seen by then, it was heard throughout
  std::int64_t late_order_until_ns_ = 0;
  bool has_looked_ = false; // at the vehicle, since this incarnation began
  question looking_ = question::none;
  std::int64_t looking_since_ns_ = 0;
  std::uint64_t reading_back_ = 0; // the number of the download
  std::uint64_t last_reading_back_ = first_reading_back;
  std::int64_t read_again_ns_ = 0;
  bool may_upload_go_on_ = false;      // in the link: one that the incarnation before has begun
  bool was_cut_off_ = false;           // what is looked at: an upload of the incarnation before
  std::uint64_t last_task_before_ = 0; // this incarnation began
};

} // namespace godwit::executor
