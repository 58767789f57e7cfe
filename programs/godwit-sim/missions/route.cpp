#include "programs/godwit-sim/missions/route.hpp"

#include <array>
#include <charconv>
#include <vector>

#include "actors/domain/mission/error.hpp"
#include "actors/domain/mission/read.hpp"

namespace godwit::sim::missions {
namespace {

using mission::in_quotes;

// After /missions/{mission_id}; * is the id of an assignment.
struct path_row {
  std::string_view method;
  std::string_view rest;
  endpoint where;
  std::size_t max_body_bytes;
};

constexpr std::array path_rows{
    path_row{"GET", "", endpoint::get_mission, 0},
    path_row{"DELETE", "", endpoint::delete_mission, 0},
    path_row{"GET", "/mapobjects", endpoint::get_map_objects, 0},
    path_row{"POST", "/mapobjects", endpoint::post_map_objects, mission::max_batch_bytes},
    path_row{"GET", "/mapobjects/ignored", endpoint::get_ignored, 0},
    path_row{"POST", "/mapobjects/ignored", endpoint::post_ignored, mission::max_batch_bytes},
    path_row{"POST", "/waypoints", endpoint::post_waypoints, mission::max_answer_bytes},
    path_row{"POST", "/tail", endpoint::post_tail, mission::max_mission_bytes},
    path_row{"GET", "/progress", endpoint::get_progress, 0},
    path_row{"POST", "/progress", endpoint::post_progress, mission::max_batch_bytes},
    path_row{"POST", "/pictures", endpoint::post_picture, mission::max_answer_bytes},
    path_row{"GET", "/assignments", endpoint::get_assignments, 0},
    path_row{"POST", "/assignments/*/response", endpoint::post_response, mission::max_answer_bytes},
};

// What a body has where the path is none of the contract: enough to read it and to say so.
constexpr std::size_t max_other_body_bytes = 64 * 1024;

constexpr std::size_t uuid_length = 36;

bool is_uuid(std::string_view text) {
  if (text.size() != uuid_length)
    return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_dash = i == 8 || i == 13 || i == 18 || i == 23;
    const bool is_digit = (text[i] >= '0' && text[i] <= '9') || (text[i] >= 'a' && text[i] <= 'f');
    if (is_dash ? text[i] != '-' : !is_digit)
      return false;
  }
  return true;
}

struct path_parts {
  std::string_view mission_id;
  std::string_view rest; // "/assignments/*/response"
  std::string pattern;
  std::string_view assignment_id;
};

// None: not below /missions/.
std::optional<path_parts> parts_of_path(std::string_view path) {
  constexpr std::string_view root = "/missions/";
  if (!path.starts_with(root))
    return std::nullopt;
  path.remove_prefix(root.size());
  path_parts parts;
  parts.mission_id = path.substr(0, path.find('/'));
  parts.rest = path.substr(parts.mission_id.size());
  parts.pattern = parts.rest;
  constexpr std::string_view assignments = "/assignments/";
  constexpr std::string_view response = "/response";
  if (parts.rest.starts_with(assignments) && parts.rest.ends_with(response) &&
      parts.rest.size() > assignments.size() + response.size()) {
    parts.assignment_id =
        parts.rest.substr(assignments.size(), parts.rest.size() - assignments.size() - response.size());
    parts.pattern = std::string(assignments) + "*" + std::string(response);
  }
  return parts;
}

std::string allowed_verbs(std::string_view pattern) {
  std::string all;
  for (const auto& row : path_rows)
    if (row.rest == pattern)
      all.append(all.empty() ? "" : ", ").append(row.method);
  return all;
}

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9')
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  if (c >= 'A' && c <= 'F')
    return c - 'A' + 10;
  return std::nullopt;
}

// %2B as +. None: no percent-encoding.
std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    const auto high = i + 2 < text.size() ? hex_digit(text[i + 1]) : std::nullopt;
    const auto low = i + 2 < text.size() ? hex_digit(text[i + 2]) : std::nullopt;
    if (!high || !low)
      return std::nullopt;
    result += static_cast<char>(*high * 16 + *low);
    i += 2;
  }
  return result;
}

struct number_row {
  std::string_view name;
  endpoint first;
  endpoint second;
  std::int64_t min;
  std::int64_t max;
  void (*set)(route& to, std::int64_t value);
};

constexpr std::array number_rows{
    number_row{"limit", endpoint::get_map_objects, endpoint::get_ignored, 1, max_page_rows,
               [](route& to, std::int64_t value) { to.limit = static_cast<std::uint64_t>(value); }},
    number_row{"after", endpoint::get_assignments, endpoint::get_assignments, 1, 2147483647,
               [](route& to, std::int64_t value) { to.after = value; }},
    number_row{"wait_s", endpoint::get_assignments, endpoint::get_next, 0, max_wait_s,
               [](route& to, std::int64_t value) { to.wait_s = static_cast<std::uint64_t>(value); }},
};

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failed == std::errc{} && end == text.data() + text.size() && !text.empty() ? std::optional(value)
                                                                                    : std::nullopt;
}

// Empty: it is understood.
std::string read_parameter(route& to, std::string_view name, const std::string& value) {
  const bool is_paged = to.where == endpoint::get_map_objects || to.where == endpoint::get_ignored;
  if (is_paged && name == "next") {
    to.next = value;
    return value.empty() || value.size() > 1024 ? "`next` is to be given back as it was" : "";
  }
  if (to.where == endpoint::get_map_objects && name == "since") {
    to.since = value;
    return value.size() > 1024 ? "`since` is to be a mark, as it was given" : "";
  }
  for (const auto& row : number_rows) {
    if (row.name != name || (row.first != to.where && row.second != to.where))
      continue;
    const auto number = whole_number(value);
    if (!number || *number < row.min || *number > row.max)
      return "The parameter " + std::string(name) + " is " + in_quotes(value) + "; allowed: a whole number from " +
             std::to_string(row.min) + " to " + std::to_string(row.max) + ".";
    row.set(to, *number);
    return {};
  }
  return "This call has no parameter " + in_quotes(name) + ".";
}

// Empty: it is understood.
std::string read_query(route& to, std::string_view query) {
  while (!query.empty()) {
    const auto pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    const auto equals = pair.find('=');
    const auto value = decoded(equals == std::string_view::npos ? std::string_view() : pair.substr(equals + 1));
    if (!value)
      return "The query is not percent-encoded as it should be.";
    if (auto wrong = read_parameter(to, pair.substr(0, equals), *value); !wrong.empty())
      return wrong;
  }
  if (to.where == endpoint::get_assignments && to.after == 0)
    return "The parameter after is missing: the revision that the vehicle has.";
  return {};
}

// Of /vehicles/{vehicle_id}/missions/next. None: it is another path.
std::optional<std::string_view> vehicle_of_path(std::string_view path) {
  constexpr std::string_view root = "/vehicles/";
  constexpr std::string_view rest = "/missions/next";
  if (!path.starts_with(root) || !path.ends_with(rest) || path.size() <= root.size() + rest.size())
    return std::nullopt;
  const auto id = path.substr(root.size(), path.size() - root.size() - rest.size());
  return id.find('/') == std::string_view::npos ? std::optional(id) : std::nullopt;
}

tl::expected<route, route_error> route_of_vehicle(std::string_view method, std::string_view path,
                                                  std::string_view vehicle_id, std::string_view query) {
  if (method != "GET")
    return tl::unexpected(route_error{405, in_quotes(method) + " is not possible there; possible: GET.", "GET"});
  const auto id = decoded(vehicle_id);
  if (!id)
    return tl::unexpected(route_error{400, "The name of the vehicle is not percent-encoded as it should be.", {}});
  route found{
      .where = endpoint::get_next, .path = std::string(path), .mission_id = {}, .assignment_id = {}, .next = {}};
  found.vehicle_id = *id;
  if (auto wrong = read_query(found, query); !wrong.empty())
    return tl::unexpected(route_error{400, std::move(wrong), {}, found.where});
  return found;
}

} // namespace

tl::expected<route, route_error> route_of(std::string_view method, std::string_view target) {
  const auto path = target.substr(0, target.find('?'));
  const auto query_text = target.size() > path.size() ? target.substr(path.size() + 1) : std::string_view();
  if (const auto vehicle = vehicle_of_path(path))
    return route_of_vehicle(method, path, *vehicle, query_text);
  const auto parts = parts_of_path(path);
  const auto nothing_there = [&] {
    return tl::unexpected(route_error{404, "There is nothing at " + in_quotes(path) + ".", {}});
  };
  if (!parts)
    return nothing_there();
  const auto allow = allowed_verbs(parts->pattern);
  if (allow.empty())
    return nothing_there();
  if (!is_uuid(parts->mission_id))
    return tl::unexpected(
        route_error{400, in_quotes(parts->mission_id) + " is no id of a mission: a UUID in lower case.", {}});
  for (const auto& row : path_rows) {
    if (row.rest != parts->pattern || row.method != method)
      continue;
    route found{.where = row.where,
                .path = std::string(path),
                .mission_id = std::string(parts->mission_id),
                .assignment_id = std::string(parts->assignment_id),
                .next = {}};
    if (auto wrong = read_query(found, query_text); !wrong.empty())
      return tl::unexpected(route_error{400, std::move(wrong), {}, row.where});
    if (row.where == endpoint::post_response && !is_uuid(parts->assignment_id))
      return tl::unexpected(route_error{
          400, in_quotes(parts->assignment_id) + " is no id of an assignment: a UUID in lower case.", {}, row.where});
    return found;
  }
  return tl::unexpected(
      route_error{405, in_quotes(method) + " is not possible there; possible: " + allow + ".", allow});
}

std::size_t max_body_bytes(std::string_view method, std::string_view target) {
  if (const auto parts = parts_of_path(target.substr(0, target.find('?'))))
    for (const auto& row : path_rows)
      if (row.rest == parts->pattern && row.method == method)
        return row.max_body_bytes;
  return max_other_body_bytes;
}

} // namespace godwit::sim::missions
