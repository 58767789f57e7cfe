// config/operator_port.openapi.json says what the port does: the same routes, and the fields that it really sends.
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/health/report.hpp"
#include "io/fields/json_schema.hpp"
#include "programs/godwitd/operator_port/stream_api.hpp"
#include "programs/godwitd/operator_port/view_api.hpp"

namespace {

using namespace godwit;
using namespace godwit::operator_port;
using nlohmann::json;

json described() {
  std::ifstream file(GODWIT_CONFIG "/operator_port.openapi.json");
  return json::parse(file, nullptr, true, true);
}

std::set<std::string> served() {
  boost::asio::io_context io;
  const auto view =
      std::make_shared<view_api>(io, view_parts{std::make_shared<health::report_port>(), {}, {}, nullptr});
  const auto stream = std::make_shared<stream_api>(io, std::make_shared<telemetry_stream::hub>());
  std::set<std::string> result;
  for (const auto& routes : {view->routes(), stream->routes()})
    for (const auto& each : routes)
      result.insert(std::string(each.method) + " " + std::string(each.path));
  return result;
}

std::set<std::string> described_routes() {
  std::set<std::string> result;
  const auto api = described();
  for (const auto& [path, calls] : api.at("paths").items())
    for (const auto& [method, call] : calls.items()) {
      std::string upper = method;
      std::ranges::transform(upper, upper.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
      result.insert(upper + " " + path);
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

TEST(operator_port_openapi, describes_the_routes_that_there_are_and_no_others) {
  EXPECT_EQ(described_routes(), served());
}

TEST(operator_port_openapi, describes_each_field_of_a_report_and_of_health) {
  const auto schemas = described().at("components").at("schemas");
  expect_covers(schemas.at("report"), io::json_schema<health::report>(), "report");
  expect_covers(schemas.at("health"), io::json_schema<health::health_status>(), "health");
}

TEST(operator_port_openapi, describes_each_topic_of_the_stream) {
  const auto schemas = described().at("components").at("schemas");
  namespace ts = telemetry_stream;
  const std::pair<ts::topic, json> topics[] = {{ts::topic::clock, io::json_schema<ts::clock_update>()},
                                               {ts::topic::link, io::json_schema<vehicle_link::connection_changed>()},
                                               {ts::topic::position, io::json_schema<ts::position_update>()},
                                               {ts::topic::attitude, io::json_schema<ts::attitude_update>()},
                                               {ts::topic::battery, io::json_schema<ts::battery_update>()},
                                               {ts::topic::flight, io::json_schema<ts::flight_update>()},
                                               {ts::topic::authority, io::json_schema<ts::authority_update>()},
                                               {ts::topic::progress, io::json_schema<ts::progress_update>()},
                                               {ts::topic::map, io::json_schema<mapobjects_store::map_status>()},
                                               {ts::topic::health, io::json_schema<health::health_status>()},
                                               {ts::topic::log, io::json_schema<ts::log_update>()}};
  EXPECT_EQ(std::size(topics), ts::topic_count);
  for (const auto& [topic, sent] : topics)
    expect_covers(schemas.at("topic_" + std::string(io::name_of(topic))), sent, std::string(io::name_of(topic)));
}

} // namespace
