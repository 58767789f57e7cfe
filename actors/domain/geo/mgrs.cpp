#include "actors/domain/geo/mgrs.hpp"

#include <algorithm>

#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

constexpr std::size_t finest_digits = 5;
constexpr std::size_t longest_name = 15; // two digits of the zone, three letters, five digits for each axis

std::string name_of(const point& at, int digits) {
  GODWIT_ASSERT(is_valid(at), "geo: a cell contains a place on the globe");
  int zone = 0;
  bool north = false;
  double x = 0;
  double y = 0;
  std::string name;
  GeographicLib::UTMUPS::Forward(at.latitude_deg, at.longitude_deg, zone, north, x, y);
  GeographicLib::MGRS::Forward(zone, north, x, y, at.latitude_deg, digits, name);
  return name;
}

} // namespace

std::string mgrs_cell(const point& at, cell_size size) { return name_of(at, static_cast<int>(size)); }

std::array<std::string, cell_sizes.size()> mgrs_cells(const point& at) {
  const auto finest = name_of(at, static_cast<int>(finest_digits));
  const auto square = finest.substr(0, finest.size() - 2 * finest_digits);
  const auto easting = finest.substr(square.size(), finest_digits);
  const auto northing = finest.substr(square.size() + finest_digits);
  std::array<std::string, cell_sizes.size()> names;
  for (std::size_t digits = 1; digits <= finest_digits; ++digits)
    names[digits - 1] = square + easting.substr(0, digits) + northing.substr(0, digits);
  return names;
}

std::optional<std::string> read_mgrs_cell(std::string_view text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto plain = [&](char c) { return digit(c) || (c >= 'A' && c <= 'Z'); };
  if (text.size() < 2 || text.size() > longest_name || !std::all_of(text.begin(), text.end(), plain))
    return std::nullopt;
  std::string name(digit(text[0]) && !digit(text[1]) ? "0" : "");
  name += text;
  int zone = 0;
  bool north = false;
  double x = 0;
  double y = 0;
  int digits = 0;
  try { // the library has no other way to say no
    GeographicLib::MGRS::Reverse(name, zone, north, x, y, digits);
  } catch (const GeographicLib::GeographicErr&) {
    return std::nullopt;
  }
  if (digits < 1 || digits > static_cast<int>(finest_digits))
    return std::nullopt;
  return name;
}

} // namespace godwit::geo
