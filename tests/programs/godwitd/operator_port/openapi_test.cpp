// config/operator_port.openapi.json says what the port does: the same routes, the fields that it really sends, and
// answers as they really are.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/health/report.hpp"
#include "io/fields/json_schema.hpp"
#include "io/json_schema/compiled_schema.hpp"
#include "programs/godwitd/operator_port/api_answers.hpp"
#include "programs/godwitd/operator_port/camera_api.hpp"
#include "programs/godwitd/operator_port/mission_api.hpp"
#include "programs/godwitd/operator_port/operator_api.hpp"
#include "programs/godwitd/operator_port/page_files.hpp"
#include "programs/godwitd/operator_port/stream_api.hpp"
#include "programs/godwitd/operator_port/view_api.hpp"
#include "programs/godwitd/operator_port/view_handler.hpp"
#include "tests/programs/godwitd/operator_port/api_world.hpp"

namespace openapi_test {

using namespace godwit;
using namespace godwit::operator_port;
using nlohmann::json;

json described() {
  std::ifstream file(GODWIT_CONFIG "/operator_port.openapi.json");
  return json::parse(file, nullptr, true, true);
}

// All but the files of the page, as the description says.
std::set<std::string> served() {
  boost::asio::io_context io;
  const auto view =
      std::make_shared<view_api>(io, view_parts{std::make_shared<health::report_port>(), {}, {}, nullptr});
  const auto stream = std::make_shared<stream_api>(io, std::make_shared<telemetry_stream::hub>());
  std::set<std::string> result;
  const auto camera = std::make_shared<camera_api>(camera_parts{});
  const auto log = std::make_shared<log_api>();
  for (const auto& routes : {view->routes(), camera->routes(), stream->routes(), routes_of(nullptr), log->routes(),
                             view_routes(nullptr, {}), mission_routes(nullptr, {}, {}), tile_routes(nullptr)})
    for (const auto& each : routes)
      result.insert(std::string(each.method) + " " + std::string(each.path));
  return result;
}

// "/points/{point}/picture" as a route says it: "/points/{}/picture".
std::string without_names(const std::string& path) {
  std::string result;
  bool is_name = false;
  for (const char each : path) {
    is_name = is_name && each != '}';
    if (!is_name)
      result += each;
    is_name = is_name || each == '{';
  }
  return result;
}

std::set<std::string> described_routes() {
  std::set<std::string> result;
  const auto api = described();
  for (const auto& [path, calls] : api.at("paths").items())
    for (const auto& [method, call] : calls.items()) {
      std::string upper = method;
      std::ranges::transform(upper, upper.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
      result.insert(upper + " " + without_names(path));
    }
  return result;
}

// Every field that is sent, with its type. What a description adds (a sentence, the words of an enum) is its own.
void expect_covers(const json& described_type, const json& sent, const std::string& where) {
  if (sent.contains("properties")) {
    ASSERT_TRUE(described_type.contains("properties")) << where << ": " << sent.dump();
    std::set<std::string> known;
    for (const auto& [name, type] : described_type.at("properties").items())
      known.insert(name);
    for (const auto& [name, type] : sent.at("properties").items()) {
      ASSERT_TRUE(known.erase(name) == 1) << where << "." << name << " is not described: " << type.dump();
      expect_covers(described_type.at("properties").at(name), type, where + "." + name);
    }
    EXPECT_TRUE(known.empty()) << where << " has no " << *known.begin();
  } else if (sent.contains("items")) {
    expect_covers(described_type.at("items"), sent.at("items"), where + "[]");
  } else if (sent.contains("anyOf")) {
    expect_covers(described_type.at("anyOf").at(0), sent.at("anyOf").at(0), where);
  } else {
    EXPECT_EQ(described_type.at("type"), sent.at("type")) << where;
  }
}

// WHAT with all that it refers to put in its place.
json resolved(const json& what, const json& api) {
  if (what.is_object() && what.contains("$ref"))
    return resolved(api.at(json::json_pointer(what.at("$ref").get<std::string>().substr(1))), api);
  auto result = what;
  if (result.is_structured())
    for (auto& each : result)
      each = resolved(each, api);
  return result;
}

// Whether ANSWER is one that is described for this call.
void expect_described(const tests::http_answer& answer, const std::string& method, const std::string& path) {
  static const auto api = described();
  const auto where = method + " " + path + " " + std::to_string(answer.status) + " " + answer.body.dump();
  const auto& responses = api.at("paths").at(path).at(method).at("responses");
  ASSERT_TRUE(responses.contains(std::to_string(answer.status))) << where;
  const auto response = resolved(responses.at(std::to_string(answer.status)), api);
  if (!response.contains("content")) {
    EXPECT_TRUE(answer.body.is_discarded()) << where;
    return;
  }
  const auto* const type = answer.status < 300 ? "application/json" : "application/problem+json";
  ASSERT_NE(answer.head.find("Content-Type: " + std::string(type)), std::string::npos) << where << answer.head;
  const io::schemas::compiled_schema schema(response.at("content").at(type).at("schema"));
  for (const auto& each : schema.problems_of(answer.body, 3))
    ADD_FAILURE() << where << ": " << each.what << ", " << each.allowed;
}

TEST(operator_port_openapi, describes_what_is_really_answered) {
  tests::api_world world;
  const auto anna = world.log_in("anna", operators::role::operator_);
  const auto eve = world.log_in("eve", operators::role::viewer);
  const auto ask = [&](const std::string& who, const std::string& method, const std::string& target, unsigned status,
                       const json& body = nullptr) {
    const auto answer = world.ask_as(who, method, target, body);
    EXPECT_EQ(answer.status, status) << method << " " << target << " " << answer.body.dump();
    std::string lower = method;
    std::ranges::transform(lower, lower.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
    expect_described(answer, lower, target.substr(0, target.find('?')));
  };
  const json place{{"latitude", 47.4}, {"longitude", 8.5}, {"altitude_m", 40}};
  const auto go_to = [&](const char* id) {
    auto said = world.command("go_to", id);
    said["place"] = place;
    return said;
  };
  ask(anna, "GET", "/api/v1/control", 200);
  ask(anna, "POST", "/api/v1/commands", 423, world.command("start", "a0"));
  ask(anna, "POST", "/api/v1/control", 200, {{"act", "take"}});
  ask(anna, "GET", "/api/v1/control", 200);
  ask(eve, "POST", "/api/v1/control", 409, {{"act", "take"}});
  ask(anna, "POST", "/api/v1/control", 400, {{"act", "seize"}});
  ask(anna, "POST", "/api/v1/control", 415);
  ask(anna, "POST", "/api/v1/commands", 200, go_to("a1"));
  ask(anna, "POST", "/api/v1/commands", 422, world.command("start", "a1"));
  auto late = world.command("resume", "a2");
  late["valid_until"] = world.utc_in(-1);
  ask(anna, "POST", "/api/v1/commands", 408, late);
  auto stale = world.command("resume", "a3");
  stale["state"] = "another";
  ask(anna, "POST", "/api/v1/commands", 412, stale);
  ask(eve, "POST", "/api/v1/commands", 403, world.command("pause", "e1"));
  ask("nobody", "POST", "/api/v1/commands", 401, world.command("pause", "n1"));
  ask(anna, "POST", "/api/v1/commands", 400, {{"command", "start"}});
  ask(eve, "GET", "/api/v1/points", 200);
  ask(anna, "POST", "/api/v1/points", 409, {{"point", 9}, {"decision", "confirm"}});
  ask(anna, "POST", "/api/v1/points", 200, {{"point", 4}, {"decision", "confirm"}});
  ask(eve, "POST", "/api/v1/points", 403, {{"point", 4}, {"decision", "confirm"}});
  ask(anna, "POST", "/api/v1/points", 400, {{"point", 4}});
  const auto bob = world.log_in("bob", operators::role::engineer);
  const json override_link{{"rule", "operator_link"}, {"seconds", 600}, {"reason", "we walk over the hill"}};
  ask(anna, "POST", "/api/v1/overrides", 403, override_link);
  ask(bob, "POST", "/api/v1/overrides", 423, override_link);
  ask(bob, "POST", "/api/v1/overrides", 400, {{"rule", "operator_link"}});
  ask(bob, "POST", "/api/v1/control", 200, {{"act", "take_over"}});
  ask(bob, "POST", "/api/v1/overrides", 200, override_link);
  ask(bob, "POST", "/api/v1/overrides", 409, {{"rule", "battery_critical"}, {"seconds", 60}, {"reason", "it lies"}});
  ask(anna, "GET", "/api/v1/audit?rows=5", 200);
  ask(anna, "GET", "/api/v1/audit?rows=0", 400);
  ask(eve, "GET", "/api/v1/audit", 403);
  ask(anna, "GET", "/api/v1/plan", 200);
  ask(anna, "GET", "/api/v1/preflight", 200);
  ask(anna, "GET", "/api/v1/map/objects?limit=5", 200);
  ask(anna, "GET", "/api/v1/map/objects?limit=none", 400);
  world.objects.failure = mapobjects_store::map_failure::broken;
  ask(anna, "GET", "/api/v1/map/objects", 503);
  ask(anna, "GET", "/api/v1/session", 200);
  ask("nobody", "POST", "/api/v1/session", 401, {{"link", "none"}});
  ask("nobody", "POST", "/api/v1/session", 400, {{"name", "anna"}});
  ask(anna, "DELETE", "/api/v1/session", 204);
  ask(anna, "GET", "/api/v1/session", 401);
}

TEST(operator_port_openapi, describes_what_is_answered_to_who_brings_a_mission) {
  tests::api_world world;
  const auto anna = world.log_in("anna", operators::role::operator_);
  const auto eve = world.log_in("eve", operators::role::viewer);
  const auto send = [&](const std::string& who, const std::string& target, const std::string& file, unsigned status) {
    const auto answer = world.send_file(target, file, who);
    EXPECT_EQ(answer.status, status) << target << " " << answer.body.dump();
    expect_described(answer, "post", target.substr(0, target.find('?')));
  };
  std::ifstream file(GODWIT_TEST_DATA "/missions/simple.plan");
  const std::string plan(std::istreambuf_iterator<char>(file), {});
  for (const std::string path : {"/api/v1/missions/check", "/api/v1/missions"}) {
    send(anna, path, plan, 400);
    send(anna, path + "?format=plan", "{", 422);
  }
  send(anna, "/api/v1/missions/check?format=plan", plan, 200);
  send(anna, "/api/v1/missions?format=plan", plan, 423);
  send(eve, "/api/v1/missions?format=plan", plan, 403);
  send({}, "/api/v1/missions?format=plan", plan, 401);
  EXPECT_EQ(world.ask_as(anna, "POST", "/api/v1/control", {{"act", "take"}}).status, 200U);
  send(anna, "/api/v1/missions?format=plan", plan, 200);
  world.is_in_flight = true;
  send(anna, "/api/v1/missions?format=plan", plan, 409);
}

TEST(operator_port_openapi, describes_the_routes_that_there_are_but_the_files_of_the_page_and_no_others) {
  EXPECT_EQ(described_routes(), served());
  const auto rule = described().at("info").at("description").get<std::string>();
  for (const auto& each : page_files()) {
    EXPECT_FALSE(described_routes().contains("GET " + std::string(each.path))) << each.path;
    EXPECT_NE(rule.find(each.path), std::string::npos) << each.path << " is left out, and not said to be";
  }
}

TEST(operator_port_openapi, describes_each_field_of_a_report_of_health_and_of_the_checks) {
  const auto api = described();
  const auto schemas = resolved(api.at("components").at("schemas"), api);
  expect_covers(schemas.at("report"), io::json_schema<health::report>(), "report");
  expect_covers(schemas.at("health"), io::json_schema<health::health_status>(), "health");
  expect_covers(schemas.at("objects"), io::json_schema<objects_on_map>(), "objects");
  expect_covers(schemas.at("preflight"), io::json_schema<executor::preflight_view>(), "preflight");
}

TEST(operator_port_openapi, what_is_to_be_known_of_a_taken_command_is_in_its_answer_and_described) {
  using operator_bridge::verdict;
  const auto said = json::parse(answer_of("a1", {verdict::taken, "another aircraft is near"}).body);
  EXPECT_EQ(said, (json{{"id", "a1"}, {"verdict", "taken"}, {"advice", "another aircraft is near"}}));
  EXPECT_FALSE(json::parse(answer_of("a1", {verdict::taken, {}}).body).contains("advice"));
  EXPECT_FALSE(json::parse(answer_of("a1", {verdict::refused, "no"}).body).contains("advice"));
  const auto known = described().at("components").at("schemas").at("taken").at("properties");
  for (const auto& [name, value] : said.items())
    EXPECT_TRUE(known.contains(name)) << name;
}

TEST(operator_port_openapi, describes_each_topic_of_the_stream) {
  const auto schemas = described().at("components").at("schemas");
  namespace ts = telemetry_stream;
  const std::pair<ts::topic, json> topics[] = {{ts::topic::clock, io::json_schema<ts::clock_update>()},
                                               {ts::topic::link, io::json_schema<vehicle_link::connection_changed>()},
                                               {ts::topic::position, io::json_schema<ts::position_update>()},
                                               {ts::topic::attitude, io::json_schema<ts::attitude_update>()},
                                               {ts::topic::battery, io::json_schema<ts::battery_update>()},
                                               {ts::topic::gps, io::json_schema<ts::gps_update>()},
                                               {ts::topic::home, io::json_schema<ts::home_update>()},
                                               {ts::topic::flight, io::json_schema<ts::flight_update>()},
                                               {ts::topic::authority, io::json_schema<ts::authority_update>()},
                                               {ts::topic::progress, io::json_schema<ts::progress_update>()},
                                               {ts::topic::map, io::json_schema<mapobjects_store::map_status>()},
                                               {ts::topic::health, io::json_schema<health::health_status>()},
                                               {ts::topic::log, io::json_schema<ts::log_update>()},
                                               {ts::topic::points, io::json_schema<ts::points_update>()},
                                               {ts::topic::missions, io::json_schema<executor::known_missions>()},
                                               {ts::topic::way_home, io::json_schema<executor::way_home_estimate>()},
                                               {ts::topic::traffic, io::json_schema<executor::heard_traffic>()}};
  EXPECT_EQ(std::size(topics), ts::topic_count);
  for (const auto& [topic, sent] : topics)
    expect_covers(schemas.at("topic_" + std::string(io::name_of(topic))), sent, std::string(io::name_of(topic)));
}

} // namespace openapi_test
