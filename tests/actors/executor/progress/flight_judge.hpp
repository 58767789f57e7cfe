// Compares each report with what the vehicle has really flown, and with the reports before it.
//
// Numbers without a gap; no generation before the newest; within a generation an index that never goes back and no item
// missing or twice; nothing reached that was not flown in that generation; reached what the vehicle was seen to have
// left; `complete` once for each revision, and after the last item; each assignment answered once, with the report
// before. Thread: one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/actors/executor/progress/model_vehicle.hpp"

namespace godwit::executor::progress::test {

class flight_judge {
public:
  flight_judge(const model_vehicle& vehicle, const std::vector<model_plan>& plans) : vehicle_(vehicle), plans_(plans) {}

  // A generation counts what the vehicle flies of PLAN from its run RUN on.
  void open(std::uint32_t number, std::size_t plan, std::size_t run, std::uint16_t start_sequence);
  [[nodiscard]] bool is_open(std::uint32_t number) const { return generations_.contains(number); }
  [[nodiscard]] std::size_t plan_of(std::uint32_t number) const { return generations_.at(number).plan; }

  // The vehicle was seen there in its run RUN while it counted.
  void see(std::uint16_t sequence, std::size_t run);
  void end_generation();

  void take(const mission::progress_report& report);
  void expect_answer(const std::string& assignment) { open_assignments_.insert(assignment); }
  void take(const assignment_answered& answer);
  [[nodiscard]] bool is_everything_answered() const { return open_assignments_.empty(); }
  void note(std::string line) { log_.push_back(std::move(line)); }
  void fail_if(bool is_wrong, std::string_view what);

  [[nodiscard]] bool is_complete(std::int32_t revision) const { return completed_.contains(revision); }
  // Reached or skipped.
  [[nodiscard]] bool is_resolved(const std::string& item) const { return resolved_.contains(item); }
  [[nodiscard]] const std::vector<mission::progress_report>& reports() const { return reports_; }
  [[nodiscard]] const std::string& violation() const { return violation_; }
  [[nodiscard]] std::string log() const;

private:
  struct generation_seen {
    std::size_t plan = 0;
    std::size_t run = 0;
    std::uint32_t start_position = 0;
    std::optional<std::uint32_t> last_position; // reached or skipped
    std::optional<std::uint32_t> last_index;
    std::set<std::uint32_t> reached; // positions
    std::uint16_t seen_at = 0;
  };

  void check_complete(const mission::progress_report& report);
  void take_item(const mission::progress_report& report);
  void check_order(const mission::progress_report& report, std::uint32_t position);

  const model_vehicle& vehicle_;
  const std::vector<model_plan>& plans_;
  std::map<std::uint32_t, generation_seen> generations_;
  std::map<std::int32_t, int> completed_;
  std::set<std::string> resolved_;
  std::set<std::string> open_assignments_;
  std::vector<mission::progress_report> reports_;
  std::vector<std::string> log_;
  std::string violation_;
};

} // namespace godwit::executor::progress::test
