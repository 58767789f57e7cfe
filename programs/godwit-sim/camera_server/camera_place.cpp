#include "programs/godwit-sim/camera_server/camera_place.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <system_error>

namespace godwit::sim {
namespace {

struct number_row {
  std::string_view name;
  std::int64_t camera_place::*member;
  std::int64_t least;
  std::int64_t most;
};

constexpr std::array number_rows{number_row{"width", &camera_place::width, 64, 1920},
                                 number_row{"height", &camera_place::height, 64, 1080},
                                 number_row{"fps", &camera_place::fps, 1, 60},
                                 number_row{"focal", &camera_place::focal_px, 50, 10'000},
                                 number_row{"seed", &camera_place::seed, 0, 1'000'000'000},
                                 number_row{"movers", &camera_place::movers, 0, 100},
                                 number_row{"north", &camera_place::north_m, -5'000, 5'000},
                                 number_row{"east", &camera_place::east_m, -5'000, 5'000},
                                 number_row{"spread", &camera_place::spread_m, 1, 5'000}};

std::optional<std::int64_t> read_number(std::string_view text) {
  std::int64_t value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

tl::unexpected<std::string> wrong(const std::string& what) {
  return tl::make_unexpected(what + "; a camera is served at rtsp://127.0.0.1:8554/camera, with ?width=, height, fps, "
                                    "focal, seed, movers, north, east and spread after it");
}

tl::expected<void, std::string> read_numbers(std::string_view query, camera_place& to) {
  while (!query.empty()) {
    const auto each = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), each.size() + 1));
    const auto name = each.substr(0, each.find('='));
    const auto* const row = std::ranges::find(number_rows, name, &number_row::name);
    if (row == number_rows.end())
      return wrong("\"" + std::string(name) + "\" means nothing there");
    const auto value = read_number(each.substr(std::min(each.size(), name.size() + 1)));
    if (!value || *value < row->least || *value > row->most)
      return wrong(std::string(name) + " is from " + std::to_string(row->least) + " to " + std::to_string(row->most));
    to.*row->member = *value;
  }
  return {};
}

} // namespace

tl::expected<camera_place, std::string> parse_camera_place(std::string_view text) {
  constexpr std::string_view scheme = "rtsp://";
  constexpr double field_of_view_rad = std::numbers::pi / 3;
  if (!text.starts_with(scheme))
    return wrong("\"" + std::string(text) + "\" is no rtsp://");
  camera_place result;
  result.focal_px = 0; // not named yet
  const auto rest = text.substr(scheme.size());
  const auto question = rest.find('?');
  if (question != std::string_view::npos)
    if (auto read = read_numbers(rest.substr(question + 1), result); !read)
      return tl::make_unexpected(std::move(read.error()));
  const auto place = rest.substr(0, question);
  const auto slash = place.find('/');
  const auto host = place.substr(0, slash);
  const auto colon = host.rfind(':');
  if (slash == std::string_view::npos || slash + 1 == place.size() || colon == std::string_view::npos || colon == 0)
    return wrong("\"" + std::string(text) + "\" lacks a host, a port or a path");
  const auto port = read_number(host.substr(colon + 1));
  if (!port || *port < 0 || *port > 65'535)
    return wrong("\"" + std::string(host.substr(colon + 1)) + "\" is no port");
  result.host = std::string(host.substr(0, colon));
  result.port = static_cast<std::uint16_t>(*port);
  result.path = std::string(place.substr(slash));
  if (result.focal_px == 0)
    result.focal_px = std::lround(static_cast<double>(result.width) / (2 * std::tan(field_of_view_rad / 2)));
  return result;
}

} // namespace godwit::sim
