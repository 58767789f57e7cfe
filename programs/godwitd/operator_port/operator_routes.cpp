#include "programs/godwitd/operator_port/operator_routes.hpp"

#include <utility>

namespace godwit::operator_port {
namespace {

constexpr std::string_view session_path = "/api/v1/session";
constexpr std::string_view commands_path = "/api/v1/commands";
constexpr std::string_view control_path = "/api/v1/control";
constexpr std::string_view audit_path = "/api/v1/audit";
constexpr std::string_view points_path = "/api/v1/points";
constexpr std::string_view overrides_path = "/api/v1/overrides";

} // namespace

route_list routes_of(const std::shared_ptr<operator_api>& api) {
  const auto plain = [api](api_act what) {
    return [api, what](const server_request& asked, responder answer) { api->ask(what, asked, std::move(answer)); };
  };
  // Each looks after the session itself.
  route_list all{
      {"POST", session_path, max_login_body,
       [api](server_request asked, responder answer) { api->log_in(std::move(asked), std::move(answer)); }},
      {"GET", session_path, 0, plain(api_act::who_am_i)},
      {"DELETE", session_path, 0, plain(api_act::log_out)},
      {"POST", commands_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->command(asked, std::move(answer)); }},
      {"GET", control_path, 0, plain(api_act::view_control)},
      {"POST", control_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->change_control(asked, std::move(answer)); }},
      {"GET", points_path, 0, plain(api_act::list_points)},
      {"POST", points_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->decide_point(asked, std::move(answer)); }},
      {"POST", overrides_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->override_rule(asked, std::move(answer)); }},
      {"GET", audit_path, 0,
       [api](const server_request& asked, responder answer) { api->read_audit(asked, std::move(answer)); }}};
  for (auto& each : all)
    each.who = access::open;
  return all;
}

} // namespace godwit::operator_port
