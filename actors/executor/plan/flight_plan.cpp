#include "actors/executor/plan/flight_plan.hpp"

#include <algorithm>

namespace godwit::executor::plan {

std::uint32_t lines_done_at(const planned_survey& survey, std::uint16_t sequence) {
  const int ends = std::clamp(sequence - survey.first_line_sequence, 0, 2 * survey.line_count);
  return survey.lines_before + static_cast<std::uint32_t>(ends / 2);
}

} // namespace godwit::executor::plan
