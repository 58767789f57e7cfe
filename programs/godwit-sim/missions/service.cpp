#include "programs/godwit-sim/missions/service.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <openssl/crypto.h>

#include "io/http/message.hpp"
#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/service_calls.hpp"

namespace godwit::sim::missions {
namespace {

struct handler_row {
  endpoint where;
  call_handler handle;
};

constexpr std::array handlers{
    handler_row{endpoint::get_mission, get_mission},
    handler_row{endpoint::delete_mission, remove_mission},
    handler_row{endpoint::get_map_objects, get_map_objects},
    handler_row{endpoint::post_map_objects, post_map_objects},
    handler_row{endpoint::get_ignored, get_ignored},
    handler_row{endpoint::post_ignored, post_ignored},
    handler_row{endpoint::post_picture, post_picture},
    handler_row{endpoint::post_waypoints, post_waypoint},
    handler_row{endpoint::post_tail, post_tail},
    handler_row{endpoint::post_progress, post_progress},
    handler_row{endpoint::get_assignments, get_assignments},
    handler_row{endpoint::post_response, post_response},
    handler_row{endpoint::get_progress, get_progress},
    handler_row{endpoint::get_next, get_next},
};

call_handler handler_of(endpoint where) {
  return std::ranges::find(handlers, where, &handler_row::where)->handle; // route_of knows no other
}

// How long it takes tells nothing about where they differ.
bool is_token(std::string_view given, const std::string& expected) {
  return !expected.empty() && given.size() == expected.size() &&
         ::CRYPTO_memcmp(given.data(), expected.data(), given.size()) == 0;
}

// None: whoever asks may do so.
std::optional<answer> not_allowed(const request& asked, const access_tokens& tokens) {
  constexpr std::string_view scheme = "Bearer ";
  const std::string_view header = asked.authorization;
  const bool is_bearer =
      header.size() > scheme.size() && io::http::equals_ignoring_case(header.substr(0, scheme.size()), scheme);
  const auto token = is_bearer ? header.substr(scheme.size()) : std::string_view();
  if (is_token(token, tokens.vehicle))
    return std::nullopt;
  if (is_token(token, tokens.foreign))
    return problem_answer(403, "This vehicle has no part in this mission.");
  auto refused = problem_answer(401, is_bearer ? "The token is not known." : "There is no bearer token.");
  refused.headers.push_back({"WWW-Authenticate", "Bearer"});
  return refused;
}

answer not_routed(const route_error& error) {
  auto refused = problem_answer(error.status, error.sentence);
  if (!error.allow.empty())
    refused.headers.push_back({"Allow", error.allow});
  return refused;
}

// None: the mission is there. Deleting twice is no error.
std::optional<answer> no_mission(const route& to, const std::optional<mission_row>& mission) {
  if (to.where == endpoint::get_next)
    return std::nullopt;
  if (!mission)
    return problem_answer(404, "There is no mission " + to.mission_id + ".");
  if (mission->deleted_at && to.where != endpoint::delete_mission)
    return problem_answer(410, "Mission " + to.mission_id + " was deleted at " + *mission->deleted_at + ".");
  return std::nullopt;
}

std::optional<answer> not_json(const request& asked) {
  if (asked.method != "POST" || io::http::has_content_type(asked.content_type, json_type))
    return std::nullopt;
  return problem_answer(400, "The Content-Type of the body has to be application/json.");
}

} // namespace

outcome service::handle(const request& asked, std::int64_t now_ns, patience how_long) {
  if (auto refused = not_allowed(asked, tokens_))
    return *std::move(refused);
  const auto to = route_of(asked.method, asked.target);
  if (!to)
    return not_routed(to.error());
  const auto mission = find_mission(*file_, to->mission_id);
  auto given = no_mission(*to, mission);
  if (!given)
    given = not_json(asked);
  if (!given)
    given = handler_of(to->where)(
        *file_, {.asked = asked, .to = *to, .mission = mission.value_or(mission_row{}), .now_ns = now_ns});
  if (file_->has_failed()) {
    file_->rollback();
    return problem_answer(500, "The file of the service: " + file_->take_error());
  }
  const bool is_poll = to->where == endpoint::get_assignments || to->where == endpoint::get_next;
  if (!is_poll || !given->body.empty())
    return *std::move(given);
  if (how_long == patience::some && to->wait_s > 0)
    return waiting{to->wait_s};
  return to->where == endpoint::get_next ? no_next() : empty_assignments();
}

endpoint endpoint_of(const request& asked) {
  const auto to = route_of(asked.method, asked.target);
  return to ? to->where : to.error().where;
}

} // namespace godwit::sim::missions
