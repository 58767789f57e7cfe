// The operator's API over a socket, with the real operator_bridge behind it and a stand-in for the executor, in one
// thread: each request is sent, everything runs until nothing is left to do, and the answer is read. Thread: one.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <nlohmann/json.hpp>

#include "actors/operator_bridge/actor.hpp"
#include "io/http/server/server.hpp"
#include "programs/godwitd/accounts/account_keeper.hpp"
#include "programs/godwitd/accounts/password.hpp"
#include "programs/godwitd/operator_port/mission_api.hpp"
#include "programs/godwitd/operator_port/operator_api.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "programs/godwitd/operator_port/view_handler.hpp"
#include "runtime/simulation/simulation.hpp"
#include "tests/programs/godwitd/scratch.hpp"
#include "tests/support/audit_rows.hpp"

namespace godwit::operator_port::tests {

// Takes what is meant for its state, and remembers it.
class executor_stand_in final : public runtime::actor_base<operator_bridge::executor_handle> {
public:
  executor_stand_in(runtime::spawn_context context, std::vector<operators::command>* heard)
      : actor_base(std::move(context)), heard_(heard) {}
  static constexpr const char* state = "ready/none/m/1/1/0";

protected:
  behavior_type handlers() override {
    return {on<operators::command>([this](const operators::command& m) {
      if (!m.state.empty() && m.state != state && !operators::is_stop(m.kind))
        return operators::answer{false, "the flight stands otherwise by now", state};
      heard_->push_back(m);
      return operators::answer{true, {}, {}};
    })};
  }

private:
  std::vector<operators::command>* heard_;
};

// Shows point 4, and closes it at the first decision.
class scan_stand_in final : public runtime::actor_base<scan_controller::operator_handle> {
public:
  scan_stand_in(runtime::spawn_context context, std::vector<scan_controller::decide_point>* heard)
      : actor_base(std::move(context)), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<scan_controller::get_points>([](const scan_controller::get_points&) {
              scan_controller::points result;
              auto& shown = result.shown.emplace_back();
              shown.number = 4;
              shown.decide_within_ms = 30'000;
              return result;
            }),
            on<scan_controller::decide_point>([this](const scan_controller::decide_point& m) {
              if (m.number != 4)
                return scan_controller::decide_answer{false, "there is no such point"};
              heard_->push_back(m);
              return scan_controller::decide_answer{true, {}};
            })};
  }

private:
  std::vector<scan_controller::decide_point>* heard_;
};

// Has one object, or can not be looked at.
class map_stand_in final : public runtime::actor_base<mapobjects_store::viewer_handle> {
public:
  map_stand_in(runtime::spawn_context context, mapobjects_store::shown_objects* seen,
               std::vector<mapobjects_store::get_objects>* heard)
      : actor_base(std::move(context)), seen_(seen), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<mapobjects_store::get_objects>([this](const mapobjects_store::get_objects& m) {
      heard_->push_back(m);
      return *seen_;
    })};
  }

private:
  mapobjects_store::shown_objects* seen_;
  std::vector<mapobjects_store::get_objects>* heard_;
};

// Takes what a failsafe takes: not of a critical battery.
class failsafe_stand_in final : public runtime::actor_base<override_handle> {
public:
  failsafe_stand_in(runtime::spawn_context context, std::vector<failsafe::override_rule>* heard)
      : actor_base(std::move(context)), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<failsafe::override_rule>([this](const failsafe::override_rule& m) {
      if (m.scope == failsafe::rule::battery_critical)
        return failsafe::override_answer{false, "a critical battery can not be overridden"};
      heard_->push_back(m);
      return failsafe::override_answer{true, {}};
    })};
  }

private:
  std::vector<failsafe::override_rule>* heard_;
};

// The executor as those see it who show a flight and bring missions.
using flight_mailbox = runtime::combine<executor::view_handle,
                                        runtime::mailbox<runtime::asks<executor::get_flight, executor::flight_status>,
                                                         runtime::asks<operators::command, operators::answer>,
                                                         runtime::tells<mission_client::mission_loaded>>>;

class flight_stand_in final : public runtime::actor_base<flight_mailbox> {
public:
  flight_stand_in(runtime::spawn_context context, const bool* is_in_flight, std::vector<mission::document>* missions)
      : actor_base(std::move(context)), is_in_flight_(is_in_flight), missions_(missions) {}

protected:
  behavior_type handlers() override {
    return {on<executor::get_plan>([](const executor::get_plan&) {
              executor::plan_view result;
              result.mission.emplace();
              result.mission->mission_id = "m";
              result.mission->items.emplace_back(mission::waypoint{"w1", {47.4, 8.5, 30}, 0, 0, {}});
              return result;
            }),
            on<executor::get_preflight>([](const executor::get_preflight&) {
              executor::preflight_view result;
              result.findings = {{"battery", "fail", "Charge it."}};
              return result;
            }),
            on<executor::get_traffic>([](const executor::get_traffic&) { return executor::heard_traffic{}; }),
            on<executor::get_flight>([this](const executor::get_flight&) {
              executor::flight_status result;
              result.in_flight = *is_in_flight_;
              return result;
            }),
            on<operators::command>([](const operators::command&) { return operators::answer{}; }),
            on<mission_client::mission_loaded>(
                [this](const mission_client::mission_loaded& m) { missions_->push_back(m.document); })};
  }

private:
  const bool* is_in_flight_;
  std::vector<mission::document>* missions_;
};

struct http_answer {
  unsigned status = 0;
  std::string head;
  std::string cookie; // that it sets
  nlohmann::json body;
};

inline constexpr std::uint16_t allowed_command = 208; // DO_PARACHUTE, by flight.allowed_commands

class api_world {
public:
  using headers = std::vector<std::pair<std::string, std::string>>;

  struct options {
    bool is_secure = false;
    std::string why_no_missions; // empty: they are taken
  };

  api_world() : api_world(options()) {}
  explicit api_world(const options& wanted) : world(disk, 1) {
    keeper = *accounts::account_keeper::open(folder.file("operators"));
    const auto executor = world.actors().add<executor_stand_in>({.name = "executor"}, {}, &obeyed);
    bridge = world.actors().add<operator_bridge::actor>({.name = "operator_bridge"}, {}, operator_bridge::settings{},
                                                        operator_bridge::executor_handle(executor));
    points = world.actors().add<scan_stand_in>({.name = "scan_controller"}, {}, &decided);
    const auto failsafe = world.actors().add<failsafe_stand_in>({.name = "failsafe"}, {}, &overridden);
    answers = std::make_shared<waiting_answers>(wanted.is_secure);
    handler = world.actors().add<operator_handler>(
        {.name = "operator_handler"}, {},
        handler_peers{
            bridge, executor, points, failsafe, [this] { return pictured; },
            [this](const auto& query, auto then) { then(godwit::audit_support::audit_rows(disk).read(query)); }},
        answers);
    const auto flight = world.actors().add<flight_stand_in>({.name = "flight"}, {}, &is_in_flight, &missions);
    const auto uploads = world.actors().add<mission_handler>(
        {.name = "mission_handler"}, {}, mission_peers{bridge, flight, flight}, answers, wanted.why_no_missions);
    objects.list.push_back({"person", {47.4, 8.5, {}}, 1'795'459'713'049'000'000, 0.9, true});
    objects.counted = 1;
    const auto map = world.actors().add<map_stand_in>({.name = "map"}, {}, &objects, &looked_at);
    const auto views = world.actors().add<view_handler>({.name = "view_handler"}, {}, executor::view_handle(flight),
                                                        mapobjects_store::viewer_handle(map), answers);
    world.start();
    world.run_until_idle();
    const auto tell = [this](api_request asked) { world.tell(handler, std::move(asked)); };
    api = std::make_shared<operator_api>(answers, *keeper, tell);
    auto list = routes_of(api);
    std::ranges::move(view_routes(answers, [this, views](view_request asked) { world.tell(views, asked); }),
                      std::back_inserter(list));
    std::ranges::move(
        mission_routes(
            answers, [this, uploads](mission_upload asked) { world.tell(uploads, std::move(asked)); },
            [this](const std::string&, const std::function<void()>& work) { return run_in_background(work); },
            {allowed_command}),
        std::back_inserter(list));
    list.push_back({"GET", "/look", 0, [](const server_request&, responder answer) { answer.send({.body = "{}"}); }});
    routes = std::make_unique<router>(std::move(list), std::vector<std::string>{}, false);
    routes->guard([this](const server_request& asked, responder answer, std::function<void(responder)> then) {
      api->admit(asked, std::move(answer), std::move(then));
    });
    routes->on_other_origin([this](const std::string& whose) { api->note_other_origin(whose); });
    io::http::server_hooks hooks;
    hooks.handle = [this](server_request asked, responder answer) {
      if (!from.empty())
        asked.from = from;
      routes->answer(std::move(asked), std::move(answer));
    };
    server = std::make_unique<io::http::server>(context, io::http::server_settings{}, std::move(hooks));
    (void)server->listen();
  }
  ~api_world() { server->end_connections(); }

  http_answer ask(const std::string& method, const std::string& target, const nlohmann::json& body = nullptr,
                  const headers& more = {}) {
    return send(method, target, body.is_null() ? std::string() : body.dump(),
                body.is_null() ? std::string() : "application/json", more);
  }
  // A file as a browser sends it.
  http_answer send_file(const std::string& target, const std::string& file, const std::string& token) {
    return send("POST", target, file, "application/octet-stream", {{"Cookie", "godwit_session=" + token}});
  }
  http_answer send(const std::string& method, const std::string& target, const std::string& text,
                   const std::string& type, const headers& more) {
    boost::asio::ip::tcp::socket socket(context);
    socket.connect({boost::asio::ip::address_v4::loopback(), server->port()});
    std::string head = method + " " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                       "Content-Length: " + std::to_string(text.size()) + "\r\n";
    if (!type.empty())
      head += "Content-Type: " + type + "\r\n";
    for (const auto& [name, value] : more)
      head += name + ": " + value + "\r\n";
    boost::asio::write(socket, boost::asio::buffer(head + "\r\n" + text));
    socket.non_blocking(true);
    std::string got;
    for (int turns = 0; turns < 10'000; ++turns) {
      world.run_until_idle();
      if (a_turn_takes.count() != 0)
        world.advance(a_turn_takes);
      context.restart();
      context.poll();
      std::array<char, 4096> piece{};
      boost::system::error_code failed;
      const auto size = socket.read_some(boost::asio::buffer(piece), failed);
      got.append(piece.data(), size);
      if (failed && failed != boost::asio::error::would_block)
        break;
    }
    return read(got);
  }
  // With the session or token of WHO.
  http_answer ask_as(const std::string& token, const std::string& method, const std::string& target,
                     const nlohmann::json& body = nullptr, headers more = {}) {
    more.emplace_back("Cookie", "godwit_session=" + token);
    return ask(method, target, body, more);
  }
  // A session that somebody has opened with the right password.
  std::string log_in(const std::string& name, operators::role as) {
    const auto token = std::string(accounts::new_token().revealed());
    (void)world.ask(bridge, std::chrono::seconds(1),
                    operator_bridge::open_session{{name, as, "stamp", {}}, accounts::hash_of_token(token), "here"});
    world.run_until_idle();
    return token;
  }
  [[nodiscard]] nlohmann::json command(const std::string& kind, const std::string& id) const {
    return {{"id", id}, {"command", kind}, {"valid_until", utc_in(10)}, {"state", executor_stand_in::state}};
  }
  [[nodiscard]] std::string utc_in(std::int64_t seconds) const;
  [[nodiscard]] std::uint32_t rows() {
    world.run_until_idle();
    std::uint32_t result = 0;
    for (const auto& each : godwit::audit_support::audit_rows(disk).read({0, 200}).rows)
      result += each.count;
    return result;
  }

  std::string from; // where requests come from; empty: this computer
  test::scratch folder;
  runtime::simulated_disk disk;
  runtime::simulation world;
  std::vector<operators::command> obeyed;
  std::vector<scan_controller::decide_point> decided;
  mapobjects_store::shown_objects objects; // what the map answers
  std::vector<mapobjects_store::get_objects> looked_at;
  std::vector<std::uint64_t> pictured; // points of interest that the camera has shown
  std::vector<failsafe::override_rule> overridden;
  std::vector<mission::document> missions; // that were handed over
  bool is_in_flight = false;
  std::chrono::milliseconds a_turn_takes{0}; // while an answer is waited for; 0: no time passes
  // Where files are read: at once, unless a test puts something else here.
  std::function<bool(const std::function<void()>& work)> run_in_background = [](const auto& work) {
    work();
    return true;
  };
  operator_bridge::own_handle bridge;
  scan_controller::operator_handle points;
  request_inlet handler;
  std::unique_ptr<accounts::account_keeper> keeper;
  std::shared_ptr<waiting_answers> answers;
  std::shared_ptr<operator_api> api;
  std::unique_ptr<router> routes;
  boost::asio::io_context context;
  std::unique_ptr<io::http::server> server;

private:
  static http_answer read(const std::string& text) {
    http_answer result;
    const auto end = text.find("\r\n\r\n");
    if (text.size() < 12 || end == std::string::npos)
      return result;
    result.head = text.substr(0, end);
    result.status = static_cast<unsigned>(std::stoi(text.substr(9, 3)));
    constexpr std::string_view name = "Set-Cookie: godwit_session=";
    if (const auto found = text.find(name); found != std::string::npos && found < end)
      result.cookie = text.substr(found + name.size(), text.find(';', found) - found - name.size());
    result.body = nlohmann::json::parse(text.substr(end + 4), nullptr, false);
    return result;
  }
};

} // namespace godwit::operator_port::tests
