#include "programs/godwit-sim/vehicle_options.hpp"

#include <cmath>
#include <optional>

#include "programs/godwit-sim/commands.hpp"
#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim {

namespace {

tl::expected<position, std::string> read_home(const std::string& text) {
  const auto parts = parts_of(text, ',');
  std::vector<double> numbers;
  for (const auto part : parts)
    if (const auto number = read_number(part))
      numbers.push_back(*number);
  if (parts.size() != 3 || numbers.size() != 3)
    return tl::make_unexpected(in_quotes(text) +
                               " is no place: LATITUDE,LONGITUDE,ALTITUDE in degrees and metres, such as "
                               "47.397742,8.545594,488");
  if (std::abs(numbers[0]) > 89 || std::abs(numbers[1]) > 180)
    return tl::make_unexpected(in_quotes(text) + " lies nowhere: a latitude is from -89 to 89 degrees (north is "
                                                 "positive), a longitude from -180 to 180 (east is positive)");
  if (numbers[2] < -500 || numbers[2] > 9'000)
    return tl::make_unexpected(in_quotes(text) + " lies too low or too high: an altitude is from -500 to 9000 metres");
  return position{numbers[0], numbers[1], numbers[2]};
}

tl::expected<personality, std::string> read_personality(const std::string& text) {
  if (const auto who = io::value_of<personality>(text))
    return *who;
  return tl::make_unexpected(in_quotes(text) +
                             " is no personality: rover, px4, ardupilot, plane, ardurover, quadplane or px4_vtol");
}

tl::expected<std::vector<io::link::uri>, std::string> read_links(const std::vector<std::string>& texts) {
  if (texts.empty() || texts.size() > max_lines)
    return tl::make_unexpected("a vehicle has 1 to " + std::to_string(max_lines) + " lines");
  std::vector<io::link::uri> result;
  for (const auto& each : texts) {
    auto where = io::link::parse_uri(each);
    if (!where)
      return tl::make_unexpected(std::move(where.error()));
    result.push_back(*std::move(where));
  }
  return result;
}

// All that is the same for each vehicle.
tl::expected<hosted_settings, std::string> read_vehicle(const vehicle_arguments& given) {
  const auto who = read_personality(given.personality);
  const auto home = read_home(given.home);
  const auto where = read_links(given.links);
  const auto faults = parse_line_faults(given.faults);
  if (!who)
    return in_option("--personality", who.error());
  if (!home)
    return in_option("--home", home.error());
  if (!where)
    return in_option("--link", where.error());
  if (!faults)
    return in_option("--faults", faults.error());
  // "nan" passes every comparison with a range.
  if (!std::isfinite(given.speed))
    return in_option("--speed", "it has to be a number, such as 20");
  if (!std::isfinite(given.battery))
    return in_option("--battery", "it has to be a number of percent, such as 80");
  hosted_settings result{.vehicle = {},
                         .where = where->front(),
                         .more_lines = {where->begin() + 1, where->end()},
                         .faults = *faults,
                         .refusals = {}};
  result.vehicle.who = *who;
  result.vehicle.home = *home;
  result.vehicle.speed = given.speed;
  result.vehicle.battery_percent = given.battery;
  result.vehicle.aircraft = given.aircraft;
  result.vehicle.has_payload = given.has_payload;
  result.vehicle.arms_on_start = given.arm_on_start;
  for (const auto& each : given.refuse) {
    const auto refusal = parse_refusal(each);
    if (!refusal)
      return in_option("--refuse", refusal.error());
    result.refusals.push_back(*refusal);
  }
  return result;
}

tl::expected<void, std::string> add_vehicles(const vehicle_arguments& given, const hosted_settings& first,
                                             host_settings& to) {
  for (int number = 0; number < given.count; ++number) {
    auto each = first;
    const auto where = link_of(first.where, number);
    if (!where)
      return in_option("--count", where.error());
    each.where = *where;
    for (auto& line : each.more_lines) {
      auto place = link_of(line, number);
      if (!place)
        return in_option("--count", place.error());
      line = *std::move(place);
    }
    each.vehicle.system = system_of(given.system, number);
    each.vehicle.seed = given.seed + static_cast<std::uint64_t>(number);
    each.vehicle.home = home_of(first.vehicle.home, number);
    to.vehicles.push_back(std::move(each));
  }
  return {};
}

} // namespace

std::uint8_t system_of(int first, int number) {
  return static_cast<std::uint8_t>((first - 1 + number) % max_system + 1);
}

tl::expected<io::link::uri, std::string> link_of(const io::link::uri& where, int number) {
  if (number == 0)
    return where;
  if (where.which == io::link::uri::kind::serial)
    return tl::make_unexpected(std::string("a serial line has room for one vehicle"));
  auto result = where;
  if (!where.listens() || where.port == 0)
    return result;
  if (where.port + number > 65'535)
    return tl::make_unexpected("there are not so many ports from " + std::to_string(where.port) + " on");
  result.port = static_cast<std::uint16_t>(where.port + number);
  return result;
}

position home_of(const position& first, int number) {
  const int column = number % vehicles_in_row;
  const int row = number / vehicles_in_row;
  const auto east = number == 0 ? first : moved(first, {90, column * distance_between_homes_m});
  return row == 0 ? east : moved(east, {0, row * distance_between_homes_m});
}

tl::expected<host_settings, std::string> read(const vehicle_arguments& given) {
  const auto vehicle = read_vehicle(given);
  if (!vehicle)
    return tl::make_unexpected(vehicle.error());
  host_settings result;
  if (auto added = add_vehicles(given, *vehicle, result); !added)
    return tl::make_unexpected(std::move(added.error()));
  for (const auto& each : given.fault_at) {
    auto fault = parse_timed_fault(each);
    if (!fault)
      return in_option("--fault-at", fault.error());
    result.faults.push_back(*std::move(fault));
  }
  if (!given.control.empty()) {
    auto where = parse_control_place(given.control);
    if (!where)
      return in_option("--control", where.error());
    result.control = *std::move(where);
  }
  if (!given.camera.empty()) {
    auto camera = parse_camera_place(given.camera);
    if (!camera)
      return in_option("--camera", camera.error());
    result.camera = *std::move(camera);
  }
  result.camera_truth = given.camera_truth;
  result.tlog = given.tlog;
  result.is_quiet = given.quiet;
  return result;
}

namespace {

// Where a station on this computer finds what listens on all interfaces.
std::string reachable(const io::link::uri& where) {
  const bool is_everywhere = where.host.empty() || where.host == "0.0.0.0" || where.host == "::";
  return io::link::host_and_port(is_everywhere ? "127.0.0.1" : where.host, where.port);
}

std::vector<std::string> lines(const std::string& qgroundcontrol, const std::string& mavproxy,
                               const std::string& mavsdk) {
  return {"  QGroundControl  " + qgroundcontrol, "  MAVProxy        mavproxy.py --master=" + mavproxy,
          "  MAVSDK          " + mavsdk};
}

} // namespace

std::vector<std::string> connection_hints(const io::link::uri& where) {
  using kind = io::link::uri::kind;
  const auto place = reachable(where);
  const auto port = std::to_string(where.port);
  switch (where.which) {
  case kind::udp_in:
    return lines("Comm Links, Add, type UDP, server address " + place, "udpout:" + place, "udpout://" + place);
  case kind::udp_out:
    return lines(where.port == 14550 ? "connects by itself" : "Comm Links, Add, type UDP, port " + port,
                 "udpin:0.0.0.0:" + port, "udpin://0.0.0.0:" + port);
  case kind::tcp_in:
    return lines("Comm Links, Add, type TCP, server address " + place, "tcp:" + place, "tcpout://" + place);
  case kind::tcp:
    return lines("does not listen on TCP", "tcpin:0.0.0.0:" + port, "tcpin://0.0.0.0:" + port);
  case kind::serial:
    break;
  }
  return {"  the other end of the line, at " + std::to_string(where.baud) + " baud"};
}

} // namespace godwit::sim
