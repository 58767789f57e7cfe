#include "programs/godwitd/page_desks.hpp"

#include <utility>

#include "programs/godwitd/child_policies.hpp"
#include "programs/godwitd/operator_port/mission_api.hpp"
#include "programs/godwitd/operator_port/tile_file.hpp"

namespace godwit::daemon {
namespace {

std::string why_no_missions(const daemon_settings& settings) {
  if (settings.service)
    return "missions come from the service: hand it over there";
  if (settings.flight.start == executor::start_policy::automatic)
    return "this godwitd starts by itself what it is given (flight.start is automatic): missions are not taken from a "
           "page";
  return {};
}

} // namespace

page_desks add_page_desks(runtime::system& actors, const daemon_settings& settings, const base_actors& base,
                          const flight_actors& flight, const answers_ptr& answers) {
  page_desks made;
  made.views = actors.add<operator_port::view_desk>({.name = "view_desk", .policy = runtime::on_crash::lose},
                                                    replaceable, executor::view_handle(flight.executor),
                                                    mapobjects_store::viewer_handle(base.store), answers);
  made.missions = actors.add<operator_port::mission_desk>(
      {.name = "mission_desk", .policy = runtime::on_crash::lose}, replaceable,
      operator_port::mission_peers{flight.bridge, flight.executor, flight.executor}, answers,
      why_no_missions(settings));
  made.allowed_commands = settings.allowed_commands;
  return made;
}

operator_port::route_list page_desk_routes(runtime::system& actors, const page_desks& desks,
                                           const answers_ptr& answers) {
  const auto way_in = std::make_shared<runtime::gateway>(actors.make_gateway("page"));
  auto result = operator_port::view_routes(
      answers, [way_in, desk = desks.views](operator_port::view_request asked) { way_in->tell(desk, asked); });
  const auto worker = std::make_shared<operator_port::background_worker>();
  const auto run = [worker](const std::string& from, std::function<void()> work) {
    return worker->run(from, std::move(work));
  };
  const auto way_of_worker = std::make_shared<runtime::gateway>(actors.make_gateway("page_files")); // one a thread
  const auto upload = [way_of_worker, desk = desks.missions](operator_port::mission_upload asked) {
    way_of_worker->tell(desk, std::move(asked));
  };
  for (auto& each : operator_port::mission_routes(answers, upload, run, desks.allowed_commands))
    result.push_back(std::move(each));
  return result;
}

operator_port::route_list tile_routes_of(const operator_port::settings& wanted,
                                         const std::function<void(const std::string& sentence)>& warn) {
  const operator_port::route none{
      "GET", "/api/v1/tiles", 0,
      [](const operator_port::server_request&, operator_port::responder answer) { answer.send({.body = "null"}); }};
  if (wanted.tiles.empty())
    return {none};
  const auto opened = operator_port::tile_file::open(wanted.tiles);
  if (opened)
    return operator_port::tile_routes(*opened);
  warn("the tiles of the map (operator.tiles): " + opened.error() + "; the page shows a grid of metres");
  return {none};
}

} // namespace godwit::daemon
