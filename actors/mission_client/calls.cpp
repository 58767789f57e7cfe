#include "actors/mission_client/calls.hpp"

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "actors/mission_client/outbox/keys.hpp"
#include "actors/mission_client/outbox/map_rows.hpp"
#include "runtime/assert.hpp"

namespace godwit::mission_client {

namespace {

std::string path_of(const std::string& mission_id) { return "/missions/" + mission_id; }

service_call get(const settings& by, std::string target, std::size_t max_answer_bytes) {
  return {.target = std::move(target),
          .max_answer_bytes = max_answer_bytes,
          .read_timeout = by.call_timeout,
          .total_timeout = by.total_timeout};
}

// The service may hold it back.
service_call poll(const settings& by, const std::string& target, std::size_t max_answer_bytes) {
  auto result = get(by, target + "wait_s=" + std::to_string(by.poll_wait.count()), max_answer_bytes);
  result.read_timeout += by.poll_wait;
  result.total_timeout += by.poll_wait;
  return result;
}

service_call post(const settings& by, std::string target, std::string key, std::string body,
                  std::size_t max_answer_bytes = mission::max_answer_bytes) {
  auto result = get(by, std::move(target), max_answer_bytes);
  result.is_post = true;
  result.key = std::move(key);
  result.body = std::move(body);
  return result;
}

} // namespace

service_call get_mission(const settings& by, const std::string& mission_id) {
  return get(by, path_of(mission_id), mission::max_mission_bytes);
}

service_call get_progress(const settings& by, const std::string& mission_id) {
  return get(by, path_of(mission_id) + "/progress", mission::max_answer_bytes);
}

service_call get_next(const settings& by, const std::string& vehicle_id) {
  return poll(by, "/vehicles/" + percent_encoded(vehicle_id) + "/missions/next?", mission::max_answer_bytes);
}

service_call get_assignments(const settings& by, const std::string& mission_id, std::int32_t after) {
  return poll(by, path_of(mission_id) + "/assignments?after=" + std::to_string(after) + "&",
              mission::max_mission_bytes);
}

service_call get_page(const settings& by, const std::string& mission_id, destination what, const std::string& next,
                      const std::optional<std::string>& since) {
  auto target = path_of(mission_id) + (what == destination::observations ? "/mapobjects" : "/mapobjects/ignored") +
                "?limit=" + std::to_string(by.page_limit);
  if (!next.empty())
    target += "&next=" + percent_encoded(next);
  if (since)
    target += "&since=" + percent_encoded(*since);
  auto result = get(by, std::move(target), mission::max_page_bytes);
  result.is_page = true;
  return result;
}

service_call post_progress(const settings& by, const std::vector<const outbox_row*>& rows) {
  GODWIT_ASSERT(!rows.empty(), "mission_client: a delivery of progress has a report");
  std::vector<std::string_view> keys;
  std::string reports;
  for (const auto* each : rows) {
    keys.emplace_back(each->key);
    reports.append(reports.empty() ? "" : ",").append(each->body);
  }
  auto key = derived_key(keys);
  auto body = R"({"idempotency_key":")" + key + R"(","reports":[)" + reports + "]}";
  return post(by, path_of(rows.front()->mission_id) + "/progress", std::move(key), std::move(body));
}

service_call post_row(const settings& by, const outbox_row& row) {
  const auto path = path_of(row.mission_id);
  if (row.to == destination::picture) {
    auto result = post(by, path + "/pictures", row.key, row.body);
    result.picture = row.subject;
    return result;
  }
  if (row.to == destination::assignment_response)
    return post(by, path + "/assignments/" + row.subject + "/response", row.key, row.body);
  return post(by, path + (row.to == destination::waypoint ? "/waypoints" : "/tail"), row.key, row.body,
              mission::max_mission_bytes);
}

service_call post_batch(const settings& by, const mapobjects_store::batch& rows) {
  const auto path = path_of(rows.mission_id) + "/mapobjects";
  if (rows.to == mapobjects_store::destination::observations)
    return post(by, path, rows.key, mission::to_text(observations_of(rows)));
  return post(by, path + "/ignored", rows.key, mission::to_text(ignored_items_of(rows)));
}

std::string percent_encoded(const std::string& text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  constexpr std::string_view unreserved = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
  std::string result;
  for (const auto character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (unreserved.find(character) != std::string_view::npos)
      result += character;
    else
      result.append("%").append(1, digits[byte >> 4U]).append(1, digits[byte & 15U]);
  }
  return result;
}

} // namespace godwit::mission_client
