// In which order the lines over an area are flown, and in which direction each.
//
// Where no dent comes between them, lines lie in one strip and are flown to and fro. A dent ends strips and begins
// others:
//
//    ┌──────────────┐       ┌──────────────┐
//    │ c c c c c c  │       │ Strip c ends where the dent begins; a and b are flown one after the other, so that
//    │ a a ┌──┐ b b │       │ the vehicle does not cross the dent with each line.
//    │ a a │  │ b b │       │
//    └─────┘  └─────┘       The next strip is the one with the nearest corner. The same area, coming from the same
//                           side, always gives the same order: who goes on with a survey counts on it.
// Thread: pure.
#pragma once

#include <span>
#include <vector>

#include "actors/executor/plan/survey/scan_lines.hpp"

namespace godwit::executor::plan {

struct flown_line {
  line_point from;
  line_point to;
};

[[nodiscard]] std::vector<flown_line> lines_in_order(std::span<const scan_row> rows, const line_point& coming_from);

} // namespace godwit::executor::plan
