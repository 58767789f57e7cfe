// What earlier missions left comes before a new one: looks what the map store owes for them, and says when all of it is
// delivered or has been tried often enough for now.
//
// A batch that the store has given out and the outbox does not know is adopted with its key: its rows may have reached
// the service already. Thread: one at a time.
#pragma once

#include <optional>
#include <string>

#include "actors/mission_client/planning_context.hpp"

namespace godwit::mission_client {

class deliveries;

// A lane whose next try is farther away has been failing for a while, and does not hold up a mission.
inline constexpr std::int64_t longest_wait_for_earlier_ns = 20 * second_ns;

class backlog final : public part {
public:
  explicit backlog(deliveries& lanes) : lanes_(lanes) {}

  void plan(planning_context& d) override;
  void on_store(planning_context& d, ticket number, const store_answer& answer) override;
  // Something may be owed again.
  void look_again() { stage_ = stage_ == stage::looked ? stage::owed : stage_; }

private:
  enum class stage { batches, owed, looked };

  void take(planning_context& d, const store::open_batches& found);
  void take(planning_context& d, const store::owed_list& found);
  [[nodiscard]] bool is_over(planning_context& d) const;

  deliveries& lanes_;
  attempt attempt_;
  stage stage_ = stage::looked;
  std::optional<std::string> waits_for_; // whose begin; empty: of the next one
};

// Tells the map store what became of missions, until it has confirmed it.
class store_operations final : public part {
public:
  explicit store_operations(backlog& after) : after_(after) {}

  void plan(planning_context& d) override;
  void on_store(planning_context& d, ticket number, const store_answer& answer) override;

private:
  backlog& after_;
  attempt attempt_;
  store_operation current_;
};

} // namespace godwit::mission_client
