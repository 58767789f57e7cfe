#include "programs/godwitd/doctor/doctor.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "io/fields/json_text.hpp"
#include "programs/common/control_client.hpp"
#include "programs/common/printable.hpp"
#include "programs/godwitd/checks/config_check.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/doctor/host_findings.hpp"
#include "programs/godwitd/doctor/line_findings.hpp"
#include "programs/godwitd/host_facts.hpp"
#include "programs/godwitd/settings.hpp"

namespace godwit::daemon::doctor {
namespace {

using json = nlohmann::json;

std::string text(const json& object, const char* key) { return object.at(key).get<std::string>(); }

bool has_source(const json& configuration) {
  const auto& mission = configuration.at("mission");
  return !text(mission, "file").empty() || !text(mission, "id").empty() ||
         !text(configuration.at("service"), "vehicle").empty() || !text(configuration.at("ground"), "uri").empty();
}

void examine_configuration(const json& configuration, findings& to) {
  if (!has_source(configuration)) {
    to.push_back(
        {grade::warning, "missions", "No source of missions is set.",
         "Use --mission FILE, --service URL with --mission-id or --vehicle-id, or --ground URI for ground stations."});
    return;
  }
  if (text(configuration.at("vehicle"), "uri").empty())
    return; // found below
  const auto settings = settings_from(configuration);
  const auto problems = settings ? problems_of(*settings) : std::vector<std::string>{settings.error()};
  for (const auto& each : problems)
    to.push_back({grade::problem, "configuration", each + "."});
  if (problems.empty())
    to.push_back({grade::good, "configuration", "The configuration can be used."});
}

void examine_line(const json& configuration, std::chrono::seconds patience, findings& to) {
  const auto& vehicle = configuration.at("vehicle");
  const auto line = io::link::parse_uri(text(vehicle, "uri"));
  const bool is_usable = line && (line->which != io::link::uri::kind::serial || state_of(line->device).may_use);
  if (!is_usable)
    return; // it is among the findings of the host
  if (control::ask_daemon(control_path(configuration), {{"do", "status"}}))
    return to.push_back(
        {grade::good, "autopilot", "A godwitd runs here and has the line; `godwitd ctl status` shows the vehicle."});
  const auto heard = listen_on(*line, patience);
  if (!heard)
    return to.push_back({grade::problem, "line", heard.error() + "."});
  std::ranges::move(
      judge_line(*heard, {*line, vehicle.at("system").get<std::uint8_t>(), !text(vehicle, "key_file").empty()}),
      std::back_inserter(to));
}

} // namespace

findings examine_host(const json& configuration) {
  findings result;
  const auto journal = journal_path(configuration);
  const auto folder = std::filesystem::absolute(journal).parent_path().string();
  result.push_back(judge_disk(folder, free_bytes_beside(journal)));
  result.push_back(judge_clock(is_clock_synchronised()));
  const auto camera = text(configuration.at("camera"), "uri");
  if (constexpr std::string_view device = "v4l2://"; camera.starts_with(device))
    result.push_back(judge_camera(camera, state_of(camera.substr(device.size()))));
  const auto where = text(configuration.at("vehicle"), "uri");
  const auto line = io::link::parse_uri(where);
  if (where.empty())
    result.push_back(judge_missing_line(serial_ports()));
  else if (!line)
    result.push_back({grade::problem, "line", "vehicle.uri: " + line.error() + "."});
  else if (line->which == io::link::uri::kind::serial)
    result.push_back(judge_serial(*line, state_of(line->device), serial_ports()));
  return result;
}

findings examine(const json& configuration, std::chrono::seconds patience) {
  findings result;
  examine_configuration(configuration, result);
  std::ranges::move(examine_host(configuration), std::back_inserter(result));
  examine_line(configuration, patience, result);
  return result;
}

bool has_problem(const findings& all) {
  return std::ranges::any_of(all, [](const finding& each) { return each.how == grade::problem; });
}

std::string text_of(const findings& all) {
  std::string result;
  for (const auto& each : all) {
    const auto name = std::string(io::name_of(each.how));
    result +=
        name + std::string(9 - name.size(), ' ') + each.subject + ": " + programs::printable(each.sentence) + "\n";
    if (!each.remedy.empty())
      result += std::string(9, ' ') + "-> " + programs::printable(each.remedy) + "\n";
  }
  return result + (has_problem(all) ? "With a problem of this list no flight starts.\n"
                                    : "Nothing keeps a flight from starting.\n");
}

json json_of(const findings& all) {
  auto listed = json::array();
  for (const auto& each : all)
    listed.push_back({{"grade", io::name_of(each.how)},
                      {"subject", each.subject},
                      {"sentence", each.sentence},
                      {"remedy", each.remedy}});
  return {{"ok", !has_problem(all)}, {"findings", std::move(listed)}};
}

} // namespace godwit::daemon::doctor
