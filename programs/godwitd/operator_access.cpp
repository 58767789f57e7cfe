#include "programs/godwitd/operator_access.hpp"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <utility>

#include "io/eyes/messages.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "programs/godwitd/operator_port/camera_api.hpp"
#include "programs/godwitd/operator_port/mission_api.hpp"
#include "programs/godwitd/operator_port/operator_api.hpp"
#include "programs/godwitd/operator_port/page_files.hpp"

namespace godwit::daemon {

namespace {

void add_to(operator_port::route_list& routes, operator_port::route_list more) {
  std::ranges::move(more, std::back_inserter(routes));
}

// Pictures come by no actor: they are large, and only the newest counts. Without a camera the route says so.
operator_port::route_list camera_routes(const operator_access::sources& from, const runtime::time_source& time) {
  const auto api = std::make_shared<operator_port::camera_api>(operator_port::camera_parts{
      [eyes = from.eyes](std::uint64_t after) { return eyes ? eyes->slot().read(after) : std::nullopt; },
      [eyes = from.eyes](std::int64_t until_ns) {
        if (eyes)
          static_cast<void>(eyes->send(io::eyes::want_picture{until_ns, operator_port::camera_api::picture_gap_ms}));
      },
      [pictures = from.pictures](std::uint64_t point) { return pictures ? pictures->of(point) : std::nullopt; },
      &time});
  return api->routes();
}

} // namespace

void operator_access::add_handlers(runtime::system& actors, const daemon_settings& wanted, const base_actors& base,
                                   const flight_actors& flight,
                                   std::function<std::vector<std::uint64_t>()> pictured_points, audit_source audit) {
  handler_ = actors.add<operator_port::operator_handler>(
      {.name = name(child_name::operator_handler)}, policy_of(child_name::operator_handler),
      operator_port::handler_peers{flight.bridge, flight.executor, flight.scan, base.failsafe,
                                   std::move(pictured_points), std::move(audit)},
      answers_);
  page_handlers_ = add_page_handlers(actors, wanted, base, flight, answers_);
}

void operator_access::make_apis(runtime::process& host, const view_surroundings& shown, const view_actors& views) {
  const auto way_in = std::make_shared<runtime::gateway>(host.actors().make_gateway("operator_port"));
  view_api_ = std::make_shared<operator_port::view_api>(
      port_.context(), operator_port::view_parts{shown.reports,
                                                 [way_in, to = health::report_handle(views.health)] {
                                                   way_in->tell(to, health::make_report{});
                                                 },
                                                 [this](io::prometheus::text_writer& out) {
                                                   port_.append_metrics(out);
                                                   stream_api_->append_metrics(out);
                                                 },
                                                 &host.time()});
  view_api_->open();
  stream_api_ = std::make_shared<operator_port::stream_api>(port_.context(), shown.stream);
}

operator_port::route_list operator_access::shown_routes(runtime::process& host, const operator_port::settings& wanted,
                                                        sources from, const sayer& say) {
  auto routes = operator_port::page_routes();
  add_to(routes, view_api_->routes());
  add_to(routes, stream_api_->routes());
  add_to(routes, log_api_->routes());
  add_to(routes, camera_routes(from, host.time()));
  add_to(routes, operator_port::document_routes(wanted.docs));
  add_to(routes, tile_routes_of(wanted, [say](const std::string& sentence) { say(sentence, true); }));
  return routes;
}

// Requests come in the thread of the port, passwords that were judged in that of the accounts.
operator_port::port_guards operator_access::add_commands(runtime::process& host, accounts::account_keeper& keeper,
                                                         operator_port::route_list& routes) {
  struct inlet {
    explicit inlet(runtime::gateway opened) : way_in(std::move(opened)) {}
    std::mutex mutex;
    runtime::gateway way_in;
  };
  const auto shared = std::make_shared<inlet>(host.actors().make_gateway("operator_api"));
  operator_api_ = std::make_shared<operator_port::operator_api>(
      answers_, keeper, [shared, handler = handler_](operator_port::api_request asked) {
        const std::lock_guard guard(shared->mutex);
        shared->way_in.tell(handler, std::move(asked));
      });
  add_to(routes, operator_port::routes_of(operator_api_));
  add_to(routes, page_handler_routes(host.actors(), page_handlers_, answers_));
  return {[api = operator_api_](const std::string& from) { api->note_other_origin(from); },
          [api = operator_api_](const operator_port::server_request& asked, operator_port::responder answer,
                                std::function<void(operator_port::responder)> then) {
            api->admit(asked, std::move(answer), std::move(then));
          }};
}

void operator_access::open(runtime::process& host, const operator_port::settings& wanted,
                           const view_surroundings& shown, const view_actors& views, sources from, sayer say) {
  make_apis(host, shown, views);
  auto routes = shown_routes(host, wanted, from, say);
  operator_port::port_guards guards;
  if (from.keeper != nullptr)
    guards = add_commands(host, *from.keeper, routes);
  guards.on_certificate = [this, say](const auto& now) { tell_certificate(now, say); };
  if (const auto opened = port_.open(wanted, std::move(routes), std::move(guards)); !opened) {
    const auto sentence = "the operator's port can not be opened: " + opened.error();
    host.health().post("operator_port", runtime::health_colour::yellow, sentence);
    return say(sentence + "\ngodwitd goes on without it; fix it and start godwitd again", true);
  }
  session_ends_ = from.session_ends;
  if (session_ends_)
    session_ends_->listen([this](const std::string& session) { port_.end_session(session); });
  tell(say);
}

void operator_access::tell_certificate(const tl::expected<std::string, std::string>& now, const sayer& say) {
  if (!now)
    return say(now.error(), true);
  say("the certificate was read anew; its fingerprint (SHA-256) is " + *now, false);
  view_->set(port_.url(), *now);
}

void operator_access::tell(const sayer& say) {
  const auto fingerprint = port_.fingerprint();
  say("what there is to see: " + port_.url() + "/", false);
  if (!fingerprint.empty())
    say(std::string(port_.is_certificate_new() ? "a new certificate was made; its" : "the certificate's") +
            " fingerprint (SHA-256) is " + fingerprint,
        port_.is_certificate_new());
  view_->set(port_.url(), fingerprint);
}

void operator_access::close() {
  if (session_ends_)
    session_ends_->listen(nullptr);
  port_.close([this] {
    view_api_->close();
    stream_api_->close();
  });
}

namespace {

std::string why_no_missions(const daemon_settings& settings) {
  if (settings.service && !settings.flight.asks_next())
    return "missions come from the service: hand it over there";
  if (settings.flight.start == executor::start_policy::automatic)
    return "this godwitd starts by itself what it is given (flight.start is automatic): missions are not taken from a "
           "page";
  return {};
}

} // namespace

page_handlers add_page_handlers(runtime::system& actors, const daemon_settings& settings, const base_actors& base,
                                const flight_actors& flight, const answers_ptr& answers) {
  page_handlers made;
  made.views = actors.add<operator_port::view_handler>(
      {.name = name(child_name::view_handler), .policy = runtime::on_crash::lose}, policy_of(child_name::view_handler),
      executor::view_handle(flight.executor), mapobjects_store::viewer_handle(base.store), answers);
  made.missions = actors.add<operator_port::mission_handler>(
      {.name = name(child_name::mission_handler), .policy = runtime::on_crash::lose},
      policy_of(child_name::mission_handler),
      operator_port::mission_peers{flight.bridge, flight.executor, flight.executor}, answers,
      why_no_missions(settings));
  made.allowed_commands = settings.allowed_commands;
  return made;
}

operator_port::route_list page_handler_routes(runtime::system& actors, const page_handlers& handlers,
                                              const answers_ptr& answers) {
  const auto way_in = std::make_shared<runtime::gateway>(actors.make_gateway("page"));
  auto result = operator_port::view_routes(
      answers, [way_in, handler = handlers.views](operator_port::view_request asked) { way_in->tell(handler, asked); });
  const auto worker = std::make_shared<operator_port::background_worker>();
  const auto run = [worker](const std::string& from, std::function<void()> work) {
    return worker->run(from, std::move(work));
  };
  const auto way_of_worker = std::make_shared<runtime::gateway>(actors.make_gateway("page_files")); // one a thread
  const auto upload = [way_of_worker, handler = handlers.missions](operator_port::mission_upload asked) {
    way_of_worker->tell(handler, std::move(asked));
  };
  for (auto& each : operator_port::mission_routes(answers, upload, run, handlers.allowed_commands))
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
