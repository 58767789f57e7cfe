// What a conversion can not carry over, and what becomes of it: a list for people, who decide whether that will do.
//
// A loss is what would change the flight. That a file has no place for our ids and revisions is none. Thread: plain
// values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::mission {

inline constexpr std::size_t max_losses = 1000; // that are listed; who reads so many?

struct loss {
  std::optional<std::size_t> item; // its place in the source, from 0 on; absent: about the whole
  std::string what;                // "NAV_WAYPOINT: pass radius 5 m"
  std::string why;                 // "a waypoint of a mission is flown to"
  std::string instead;             // "flown to": what a partial conversion makes of it
  std::string line{};              // "line 7", in a file of lines

  GODWIT_FIELDS(loss, "mission.loss", item, what, why, instead, line);
  friend bool operator==(const loss&, const loss&) = default;

  // "item 3: NAV_WAYPOINT: pass radius 5 m; a waypoint of a mission is flown to; instead: flown to", and
  // "item 3 (line 7): ..."
  [[nodiscard]] std::string message() const;
};

struct loss_list {
  std::vector<loss> all;
  std::size_t omitted = 0; // beyond max_losses

  void add(loss each);
  void add(loss_list others);
  [[nodiscard]] bool empty() const { return all.empty(); }
  // One line for each.
  [[nodiscard]] std::string message() const;
};

} // namespace godwit::mission
