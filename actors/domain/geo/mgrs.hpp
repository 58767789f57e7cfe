// Cells of the Military Grid Reference System: squares of 1 m to 10 km that have a name, such as 04QFJ12345678.
//
// The name of a larger cell is the name of a smaller one with fewer digits. Beyond 84 degrees north and 80 degrees
// south the same names come from the polar grid (UPS). Thread: pure. Source: NGA.STND.0037 (GeographicLib, MGRS).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "actors/domain/geo/point.hpp"

namespace godwit::geo {

// Digits for each axis.
enum class cell_size { km_10 = 1, km_1 = 2, m_100 = 3, m_10 = 4, m_1 = 5 };

inline constexpr std::array<cell_size, 5> cell_sizes{cell_size::km_10, cell_size::km_1, cell_size::m_100,
                                                     cell_size::m_10, cell_size::m_1};

// The cell in which a valid point lies.
[[nodiscard]] std::string mgrs_cell(const point& at, cell_size size);

// All five cells in which a point lies, from 10 km down to 1 m.
[[nodiscard]] std::array<std::string, cell_sizes.size()> mgrs_cells(const point& at);

// The name of a cell of one of these sizes as this file writes it: capital letters, no blanks, the zone with two
// digits. Nothing where the text names no such cell; only a zone of one digit is put right.
[[nodiscard]] std::optional<std::string> read_mgrs_cell(std::string_view text);

} // namespace godwit::geo
