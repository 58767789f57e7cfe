// What is wrong with a plan file, as a value for the caller and a sentence for people. Thread: a value.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"

namespace godwit::io::mavlink {

enum class waypoint_errc {
  not_a_plan,     // the first line is not the header
  other_version,  // a header of a version that is not read
  too_large,      // more items, longer lines or more blank lines than there may be
  wrong_columns,  // not as many as the version has
  not_a_number,   // not the kind of number that the column holds
  out_of_range,   // a number that can not be there
  wrong_sequence, // of items that a jump names by their index, or that are written: 0, 1, 2, ...
  unknown_frame,
  io, // the system refused; `what` has its words
};

GODWIT_ENUM_NAMES(waypoint_errc, not_a_plan, other_version, too_large, wrong_columns, not_a_number, out_of_range,
                  wrong_sequence, unknown_frame, io);

struct waypoint_error {
  waypoint_errc code{};
  std::string file;   // empty if the text was in memory
  std::size_t line{}; // from 1 on, 0 if it is about the whole file
  std::string column; // as in format.hpp, empty if it is about the whole line
  std::string what{}; // a sentence without an end

  // "survey.waypoints: line 5, x/lat: "95" is not from -90 to 90"
  [[nodiscard]] std::string message() const;
  bool operator==(const waypoint_error&) const = default;
};

template <class T>
using waypoint_result = tl::expected<T, waypoint_error>;

// Somebody else's text in a sentence of ours: in quotes, cut to a length, with a question mark for what is not plain.
[[nodiscard]] std::string in_quotes(std::string_view text);

} // namespace godwit::io::mavlink
