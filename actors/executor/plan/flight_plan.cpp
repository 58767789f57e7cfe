#include "actors/executor/plan/flight_plan.hpp"

#include <algorithm>

namespace godwit::executor::plan {

std::uint32_t lines_done_at(const planned_survey& survey, std::uint16_t sequence) {
  const int begun = sequence - survey.first_line_sequence + survey.items_after_line;
  return survey.lines_before +
         static_cast<std::uint32_t>(std::clamp(begun / int{survey.items_per_line}, 0, int{survey.line_count}));
}

} // namespace godwit::executor::plan
