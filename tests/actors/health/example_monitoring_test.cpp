// The examples in packaging/ for Prometheus and Grafana ask for figures, labels and values that /metrics has. That
// their expressions and alerts are right is tried by promtool where it is installed (ctest scripts.alert_rules); the
// form of the dashboard by its schema (scripts/check_json).
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/health/report_text.hpp"

namespace example_monitoring_test {

using namespace godwit;

// The values of the labels of each family that is exported.
using families = std::map<std::string, std::map<std::string, std::set<std::string>>>;

const std::regex label_text(R"re(([a-z]+)=~?"([^"]*)")re");

template <class Take>
void for_each_match(const std::string& text, const std::regex& what, Take take) {
  for (std::sregex_iterator each(text.begin(), text.end(), what), end; each != end; ++each)
    take(*each);
}

void add_figures(families& to, const health::report& made) {
  io::prometheus::text_writer out;
  health::append_metrics(out, made);
  const std::regex sample(R"re((?:^|\n)(godwit_[a-z_]+)(\{[^\n]*\})? )re");
  for_each_match(out.text(), sample, [&](const std::smatch& found) {
    auto& labels = to[found[1]];
    for_each_match(found[2], label_text, [&](const std::smatch& label) { labels[label[1]].insert(label[2]); });
  });
}

// Of a godwitd that has everything, in each state that a label shows.
families exported() {
  health::report made;
  made.health.parts.push_back({"journal", health::colour::red, "", 1});
  made.flight.emplace();
  made.failsafe.emplace();
  made.vehicle.emplace();
  made.vehicle->last_heartbeat_age_ms = 1;
  made.vehicle->parse_errors.push_back({"bad_crc", 3});
  made.vehicle->signing_errors.push_back({"wrong_key", 3});
  made.ground.emplace();
  made.ground->counts.push_back({"passed_to_vehicle", 4});
  made.service.emplace();
  made.service->last_fetch_ns = 1;
  made.service->schema_version = "2.0";
  made.map.emplace();
  made.fleet.emplace();
  for (const auto* name : {"executor", "scan_controller", "fleet_link"})
    made.actors.push_back({.name = name, .last_crash = "", .health_reason = ""});
  made.mail.push_back({.actor = "executor"});
  made.process.free_disk_bytes = 5;
  families result;
  using mission_client::connection_state;
  using mission_client::pull_state;
  for (const auto state : {connection_state::unknown, connection_state::reachable, connection_state::unreachable}) {
    made.service->connection = state;
    add_figures(result, made);
  }
  for (const auto state : {pull_state::not_started, pull_state::in_flight, pull_state::synced,
                           pull_state::cached_fallback, pull_state::failed}) {
    made.service->pull = state;
    add_figures(result, made);
  }
  return result;
}

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(GODWIT_PACKAGING) + "/" + file);
  EXPECT_TRUE(in.is_open()) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_of_the_scrape(const std::string& label) { return label == "instance" || label == "job"; }

void expect_value(const families& known, const std::string& name, const std::string& label, const std::string& value) {
  const std::regex either("[^|]+");
  for_each_match(value, either, [&](const std::smatch& one) {
    EXPECT_TRUE(known.at(name).contains(label) && known.at(name).at(label).contains(one[0]))
        << name << "{" << label << "=" << one[0] << "}";
  });
}

// The families that EXPRESSION asks for; all of it is exported.
std::set<std::string> expect_exported(const families& known, const std::string& expression) {
  std::set<std::string> result;
  const std::regex selector(R"re((godwit_[a-z_]+)(\{[^}]*\})?)re");
  for_each_match(expression, selector, [&](const std::smatch& found) {
    result.insert(found[1]);
    if (!known.contains(found[1])) {
      ADD_FAILURE() << found[1] << " is not exported";
      return;
    }
    for_each_match(found[2], label_text, [&](const std::smatch& label) {
      if (!is_of_the_scrape(label[1]))
        expect_value(known, found[1], label[1], label[2]);
    });
  });
  return result;
}

TEST(example_monitoring, alerts_ask_for_what_is_exported) {
  const auto known = exported();
  EXPECT_GT(expect_exported(known, text_of("prometheus/godwit.rules.yml")).size(), 15U);
  (void)expect_exported(known,
                        std::regex_replace(text_of("prometheus/godwit_test.yml"), std::regex("godwit_test"), ""));
}

TEST(example_monitoring, the_dashboard_asks_for_and_names_what_is_exported) {
  const auto known = exported();
  const auto dashboard = nlohmann::json::parse(text_of("grafana/godwit.json"));
  const std::regex shown(R"re(\{\{([a-z]+)\}\})re");
  for (const auto& panel : dashboard.at("panels"))
    for (const auto& target : panel.at("targets")) {
      const auto names = expect_exported(known, target.at("expr"));
      EXPECT_FALSE(names.empty()) << target;
      for_each_match(target.at("legendFormat").get_ref<const std::string&>(), shown, [&](const std::smatch& label) {
        for (const auto& name : names)
          EXPECT_TRUE(is_of_the_scrape(label[1]) || known.at(name).contains(label[1])) << target;
      });
    }
  for (const auto& variable : dashboard.at("templating").at("list"))
    (void)expect_exported(known, variable.at("query"));
}

} // namespace example_monitoring_test
