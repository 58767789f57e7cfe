#include "actors/executor/preflight/report.hpp"

#include <algorithm>

#include "actors/executor/preflight/checks.hpp"

namespace godwit::executor::preflight {

report run_checks(const facts& seen, const settings& set) {
  report result;
  if (const auto* mission = seen.mission.document; mission != nullptr) {
    result.mission_id = mission->mission_id;
    result.revision = mission->revision;
  }
  for (const auto& each : checks) {
    auto found = each.look(seen, set);
    result.findings.push_back({std::string(each.name), found.how, std::move(found.sentence)});
  }
  result.overall = worst_of(result.findings);
  return result;
}

verdict worst_of(const std::vector<finding>& all) {
  const auto worst = std::ranges::max_element(all, {}, &finding::how);
  return worst == all.end() ? verdict::fail : worst->how;
}

std::vector<std::string> sentences_of(const report& what, verdict how) {
  std::vector<std::string> result;
  for (const auto& each : what.findings)
    if (each.how == how)
      result.push_back(each.sentence);
  return result;
}

} // namespace godwit::executor::preflight
