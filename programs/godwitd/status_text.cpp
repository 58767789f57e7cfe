#include "programs/godwitd/status_text.hpp"

#include <cstdint>

namespace godwit::daemon {
namespace {

using json = nlohmann::json;

std::string number(const json& part, const char* key) { return std::to_string(part.value(key, std::uint64_t{0})); }

std::string text(const json& part, const char* key) { return part.value(key, std::string()); }

std::string in_brackets(const std::string& reason) { return reason.empty() ? "" : " (" + reason + ")"; }

std::string run_line(const json& run) {
  const auto& seen = run.at("sightings");
  return "mission " + text(run, "mission_id") + ": " + text(run, "phase") + "; sightings: " + number(seen, "recorded") +
         " recorded, " + number(seen, "refused") + " refused, " + number(seen, "unreadable") + " unreadable";
}

std::string service_line(const json& service) {
  return text(service, "connection") + ", mission revision " + number(service, "revision") + ", map " +
         text(service, "pull") + "; outbox: " + number(service, "pending") + " pending, " +
         number(service, "orphaned") + " orphaned, " + number(service, "expired") + " expired" +
         in_brackets(text(service, "last_error"));
}

std::string map_line(const json& map) {
  return text(map, "sync") + ", " + number(map, "objects") + " objects pulled, " + number(map, "seen_here") +
         " found or moved since; to deliver: " + number(map, "pending") + " and " + number(map, "taken") +
         " on their way, " + number(map, "orphaned") + " orphaned";
}

std::string vehicle_line(const json& vehicle) {
  const auto system = vehicle.value("system", 0);
  return text(vehicle, "phase") + (system == 0 ? "" : ", system " + std::to_string(system)) +
         in_brackets(text(vehicle, "reason"));
}

struct part_row {
  const char* key;
  std::string (*line)(const json& part);
};

constexpr part_row parts[] = {
    {"run", run_line}, {"service", service_line}, {"map", map_line}, {"vehicle", vehicle_line}};

} // namespace

std::string status_text(const json& answer) {
  std::string result;
  for (const auto& row : parts) {
    const auto part = answer.find(row.key);
    if (part == answer.end() || !part->is_object())
      continue;
    result += (result.empty() ? "" : "\n") + std::string(row.key) +
              std::string(9 - std::char_traits<char>::length(row.key), ' ') +
              (part->contains("error") && !part->contains("sync") ? text(*part, "error") : row.line(*part));
  }
  return result;
}

std::string retry_text(const json& answer) {
  return number(answer, "tried_now") + " pending, tried now; " + number(answer, "queued") + " queued again";
}

} // namespace godwit::daemon
