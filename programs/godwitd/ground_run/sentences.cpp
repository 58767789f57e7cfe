#include "programs/godwitd/ground_run/sentences.hpp"

#include <array>
#include <cstdio>

namespace godwit::ground_run {
namespace {

using mission_client::pull_state;
using mission_client::refusal;

std::string counted(std::uint64_t count, const char* one, const char* several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

std::string in_seconds(double duration_s) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", duration_s);
  return text.data();
}

const char* what_to_do(refusal why) {
  switch (why) {
  case refusal::unreachable:
    return "Is the address right, is there a network, does the service run?";
  case refusal::not_allowed:
    return "Put the right token into the token file, and start godwitd again.";
  case refusal::not_found:
    return "Are the mission's id and the service's address right?";
  case refusal::deleted:
    return "Start godwitd with another mission.";
  case refusal::invalid:
    return "Whoever made the mission has to fix it.";
  case refusal::misconfigured:
    break;
  }
  return "Mend it, and start godwitd again.";
}

constexpr const char* without_map =
    "Sightings are kept and delivered all the same, but they are compared with what is on board only.";

} // namespace

std::string sentence_of(const mission_client::mission_loaded& news) {
  const auto& mission = news.document;
  const auto* const how = news.cause == mission_client::load_cause::fetched ? "loaded" : "changed by the service";
  return "mission " + mission.mission_id + " " + how + ": revision " + std::to_string(mission.revision) + ", " +
         counted(mission.items.size(), "item", "items") + ", " +
         counted(mission.geofences.size(), "geofence", "geofences");
}

std::string sentence_of(const mission_client::mission_refused& news) {
  auto result = "mission " + news.mission_id + " is refused: " + news.reason + "\n" + what_to_do(news.why);
  if (!news.sample.empty())
    result += "\nWhat came begins with: " + news.sample;
  return result;
}

std::string sentence_of(const mission_client::map_pulled& news, std::optional<double> pull_s) {
  if (news.state == pull_state::synced)
    return "map pulled: " + counted(news.objects, "object", "objects") + ", " +
           counted(news.ignored, "ignored item", "ignored items") + (pull_s ? " in " + in_seconds(*pull_s) : "");
  return "the map could not be pulled: " + news.reason + "\n" + sentence_of(news.state);
}

std::string sentence_of(pull_state ended) {
  std::string result;
  switch (ended) {
  case pull_state::cached_fallback:
    result = "The copy from an earlier pull is there. ";
    break;
  case pull_state::failed:
    result = "There is no copy from an earlier pull. ";
    break;
  default:
    return "its map is on board from an earlier run";
  }
  result += without_map;
  return result;
}

std::string sentence_of(const sighting_counts& counts) {
  auto result = counted(counts.recorded, "sighting", "sightings") + " recorded";
  if (counts.refused != 0)
    result += ", " + std::to_string(counts.refused) + " refused";
  if (counts.unreadable != 0)
    result += ", " + counted(counts.unreadable, "line", "lines") + " unreadable";
  return result;
}

std::string delivery_sentence(const mission_client::service_status& now) {
  if (now.may_deliver)
    return "the delivery fails, and is tried again: " + now.delivery_error;
  return "the service does not allow the delivery: " + now.delivery_error +
         "\nWhat is not delivered is kept on board. Put the right token into the token file; then "
         "`godwitd ctl outbox-retry` tries again, or the next start of godwitd.";
}

std::string kept_sentence(const mission_client::mission_resolved& news, std::uint64_t on_map) {
  std::string result = counted(news.orphaned, "delivery", "deliveries") + " orphaned, " + std::to_string(news.expired) +
                       " expired, " + counted(on_map, "row", "rows") + " left on the map";
  result +=
      ": they are kept on board. `godwitd --outbox` and `godwitd ctl status` show more, `godwitd ctl outbox-retry` "
      "tries them again while godwitd runs.";
  return result;
}

std::string sentence_of(const mission_client::change_outcome& news) {
  return "change " + news.key + ": " + std::string(io::name_of(news.verdict)) +
         (news.reason.empty() ? "" : ": " + news.reason);
}

std::string sentence_of(const vehicle_link::connection_changed& news) {
  return "vehicle " + std::string(io::name_of(news.phase)) + (news.reason.empty() ? "" : ": " + news.reason);
}

} // namespace godwit::ground_run
