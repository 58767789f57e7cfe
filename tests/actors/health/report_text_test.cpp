#include "actors/health/report_text.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace report_text_test {

using namespace godwit;
using namespace godwit::health;

report whole() {
  report made;
  made.at_ms = 1'800'000'000'000;
  made.health.parts.push_back({"journal", colour::red, "the disk said \"no\"\nand again", 1});
  made.health.worst = colour::red;
  made.flight.emplace();
  made.failsafe.emplace();
  made.vehicle.emplace();
  made.vehicle->last_heartbeat_age_ms = 1500;
  made.vehicle->parse_errors.push_back({"bad_crc", 3});
  made.ground.emplace();
  made.ground->counts.push_back({"passed_to_vehicle", 4});
  made.vehicle->signing_errors.push_back({"wrong_key", 2});
  made.vehicle->signing_enabled = true;
  made.vehicle->rx_seq = 200;
  made.vehicle->tx_seq = 7;
  made.service.emplace();
  made.service->pull = mission_client::pull_state::cached_fallback;
  made.service->last_fetch_ns = 1'800'000'000'500'000'000;
  made.service->schema_version = "2.0";
  made.map.emplace();
  made.actors.push_back(
      {.name = "executor", .phase = runtime::child_phase::running, .last_crash = "", .health_reason = ""});
  made.mail.push_back({.actor = "executor", .waiting = 7, .accepted = 20});
  made.process.free_disk_bytes = 5;
  return made;
}

std::string metrics_of(const report& made) {
  io::prometheus::text_writer out;
  append_metrics(out, made);
  return out.text();
}

TEST(health_report, json_has_each_field_and_what_there_is_none_of_is_null) {
  const auto document = nlohmann::json::parse(json_of(whole()));
  EXPECT_EQ(document.at("health").at("worst"), "red");
  EXPECT_EQ(document.at("mail").at(0).at("waiting"), 7);
  EXPECT_EQ(document.at("actors").at(0).at("phase"), "running");
  EXPECT_TRUE(nlohmann::json::parse(json_of(report{})).at("flight").is_null());
}

TEST(health_report, figures_are_counted_by_actor) {
  const auto text = metrics_of(whole());
  EXPECT_NE(text.find("godwit_actor_up{actor=\"executor\"} 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("godwit_actor_mailbox_messages{actor=\"executor\"} 7\n"), std::string::npos);
  EXPECT_NE(text.find("godwit_part_health{part=\"journal\"} 2\n"), std::string::npos);
  EXPECT_NE(text.find("godwit_vehicle_heartbeat_age_seconds 1.5\n"), std::string::npos);
}

TEST(health_report, figures_name_the_pull_the_last_fetch_the_schema_the_signing_and_the_numbers_of_frames) {
  const auto text = metrics_of(whole());
  for (const auto* line :
       {"godwit_map_pull{state=\"cached_fallback\"} 1\n", "godwit_service_last_fetch_time_seconds 1800000000.5\n",
        "godwit_service_schema_info{version=\"2.0\"} 1\n", "godwit_vehicle_signing 1\n",
        "godwit_vehicle_signing_errors_total{cause=\"wrong_key\"} 2\n", "godwit_vehicle_sequence_received 200\n",
        "godwit_vehicle_sequence_sent 7\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  auto never = whole();
  never.service = mission_client::service_status{};
  EXPECT_EQ(metrics_of(never).find("last_fetch"), std::string::npos);
  EXPECT_EQ(metrics_of(never).find("schema_info"), std::string::npos);
}

TEST(health_report, there_are_no_figures_of_what_there_is_none_of) {
  const auto text = metrics_of({});
  for (const auto* part : {"godwit_vehicle_", "godwit_flight_", "godwit_map_", "godwit_ground_", "godwit_failsafe_"})
    EXPECT_EQ(text.find(part), std::string::npos) << part;
}

// Prometheus, "Metric and label naming": prefix, base units, _total after counters and nowhere else; each family once.
TEST(health_report, names_keep_to_the_conventions_of_prometheus) {
  const std::regex head("# (HELP|TYPE) (godwit_[a-z_]+)( .+)");
  const std::regex sample(R"re((godwit_[a-z_]+)(\{[a-z]+="[^"\n]*"(,[a-z]+="[^"\n]*")*\})? [-+0-9.eInf]+)re");
  std::set<std::string> families;
  std::istringstream lines(metrics_of(whole()));
  for (std::string line, family, kind; std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, found, head)) {
      family = found[2];
      kind = found[3];
      if (found[1] == "HELP")
        EXPECT_TRUE(families.insert(family).second) << family << " twice";
      else
        EXPECT_EQ(family.ends_with("_total"), kind == " counter") << line;
    } else {
      ASSERT_TRUE(std::regex_match(line, found, sample)) << line;
      EXPECT_EQ(found[1], family) << line;
    }
    EXPECT_EQ(line.find("_ms "), std::string::npos) << "seconds are the base unit";
  }
  EXPECT_GT(families.size(), 60U);
}

} // namespace report_text_test
