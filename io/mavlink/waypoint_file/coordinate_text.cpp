#include "io/mavlink/waypoint_file/coordinate_text.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace godwit::io::mavlink {

namespace {

struct form {
  int decimals;
  std::int32_t scale; // 10 to the power of decimals
};

constexpr form form_of(coordinate_kind kind) {
  switch (kind) {
  case coordinate_kind::global:
    return {7, units_of(kind)};
  case coordinate_kind::local:
    return {4, units_of(kind)};
  case coordinate_kind::none:
    break;
  }
  return {0, units_of(kind)};
}

constexpr std::int32_t degrees_of(axis which) { return which == axis::x ? 90 : 180; }

waypoint_error refused(waypoint_errc code, std::string what) { return {code, {}, 0, {}, std::move(what)}; }

waypoint_error not_on_earth(axis which, const std::string& text) {
  const auto degrees = std::to_string(degrees_of(which));
  return refused(waypoint_errc::out_of_range, text + " is not from -" + degrees + " to " + degrees + " degrees");
}

bool is_on_earth(axis which, double degrees_e7) {
  return std::abs(degrees_e7) <= static_cast<double>(degrees_of(which)) * form_of(coordinate_kind::global).scale;
}

} // namespace

tl::expected<std::int32_t, waypoint_error> read_coordinate(coordinate_kind kind, axis which, std::string_view text) {
  double value = 0;
  const auto [stopped, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || stopped != text.data() + text.size() || !std::isfinite(value))
    return tl::make_unexpected(refused(waypoint_errc::not_a_number, in_quotes(text) + " is not a number"));
  if (kind == coordinate_kind::none && value != std::trunc(value))
    return tl::make_unexpected(refused(waypoint_errc::not_a_number,
                                       in_quotes(text) + " is not a whole number, and without a position nothing else "
                                                         "can be sent here"));
  const double scaled = std::round(value * form_of(kind).scale);
  constexpr double limit = std::numeric_limits<std::int32_t>::max();
  if (kind == coordinate_kind::global && !is_on_earth(which, scaled))
    return tl::make_unexpected(not_on_earth(which, in_quotes(text)));
  if (scaled < -limit - 1 || scaled > limit)
    return tl::make_unexpected(refused(waypoint_errc::out_of_range, in_quotes(text) + " does not fit into 32 bits"));
  return static_cast<std::int32_t>(scaled);
}

tl::expected<void, waypoint_error> append_coordinate(std::string& out, coordinate_kind kind, axis which,
                                                     std::int32_t value) {
  const form shape = form_of(kind);
  const std::int64_t size = std::abs(std::int64_t{value}); // the lowest integer has no positive one of its size
  std::string text = (value < 0 ? "-" : "") + std::to_string(size / shape.scale);
  if (shape.decimals != 0) {
    const auto digits = std::to_string(size % shape.scale);
    text += '.' + std::string(static_cast<std::size_t>(shape.decimals) - digits.size(), '0') + digits;
  }
  if (kind == coordinate_kind::global && !is_on_earth(which, value))
    return tl::make_unexpected(not_on_earth(which, text));
  out += text;
  return {};
}

} // namespace godwit::io::mavlink
