#include "actors/executor/scan_sentences.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "io/fields/field_table.hpp"

namespace godwit::executor {

std::string sentence_about(const scan_controller::point_shown& m) {
  std::array<char, 48> place{};
  std::snprintf(place.data(), place.size(), "%.5f,%.5f", m.position.latitude_deg, m.position.longitude_deg);
  return "point " + std::to_string(m.number) + ": " + m.class_group + ", " +
         std::to_string(std::lround(m.confidence * 100)) + " %, " + (m.has_moved ? "moved, " : "") + "at " +
         place.data() + "; decide within " + std::to_string(m.window_ms / 1'000) + " s";
}

std::string sentence_about(const scan_controller::point_closed& m) {
  const auto point = "point " + std::to_string(m.number);
  if (m.outcome == scan_controller::point_outcome::passed_over)
    return point + " is passed over: nobody has decided";
  return point + " is " + std::string(io::name_of(m.outcome)) + " by " + m.by;
}

} // namespace godwit::executor
