#include "tests/actors/mission_client/scripted_service.hpp"

#include <algorithm>
#include <cstdio>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission_client::test {

namespace {

service_answer plain(unsigned status, std::string body) { return {.status = status, .body = std::move(body)}; }

service_answer problem(unsigned status, const std::string& detail) {
  return plain(status, R"({"title":"scripted","status":)" + std::to_string(status) + R"(,"detail":")" + detail + "\"}");
}

service_answer receipt(std::uint32_t stored, std::uint32_t repeated) {
  return plain(200, mission::to_text(mission::receipt{stored, repeated}));
}

std::string parameter(const std::string& query, const std::string& name) {
  const auto at = ("&" + query).find("&" + name + "=");
  if (at == std::string::npos)
    return {};
  const auto from = at + name.size() + 1;
  return query.substr(from, query.find('&', from) - from);
}

std::string lane_of(const service_call& call) { return call.target.substr(0, call.target.find('?')); }

mission::progress_status progress_of(const service_mission& m) {
  mission::progress_status result{static_cast<std::uint32_t>(m.reports.size()), {}};
  if (!m.reports.empty())
    result.last_report = m.reports.back();
  return result;
}

std::optional<std::size_t> behind(const mission::document& document, const std::optional<std::string>& item) {
  if (!item)
    return 0;
  for (std::size_t i = 0; i < document.items.size(); ++i)
    if (mission::id_of(document.items[i]) == *item)
      return i + 1;
  return std::nullopt;
}

} // namespace

service_mission& scripted_service::add(mission::document document) {
  const auto id = document.mission_id;
  missions[id].document = std::move(document);
  return missions[id];
}

int scripted_service::count(const std::string& part) const {
  int result = 0;
  for (const auto& [what, times] : calls)
    if (what.find(part) != std::string::npos)
      result += times;
  return result;
}

int scripted_service::posts(const std::string& part) const {
  int result = 0;
  for (const auto& [lane, times] : calls)
    if (lane.starts_with("POST ") && lane.find(part) != std::string::npos)
      result += times;
  return result;
}

// -- time -----------------------------------------------------------------------------------------

void scripted_service::run(const std::shared_ptr<scripted_port>& port, std::int64_t now_ns,
                           const std::function<void()>& wake) {
  accept(port, now_ns);
  bool wakes = false;
  for (auto each = open_.begin(); each != open_.end();) {
    const auto to = each->port.lock();
    const bool is_dead = to == nullptr || std::ranges::find(to->cancelled, each->number) != to->cancelled.end();
    if (!is_dead && !advance(*each, now_ns)) {
      ++each;
      continue;
    }
    if (!is_dead) {
      each->answer->number = each->number;
      wakes = to->answers().put(std::move(*each->answer)) || wakes;
    }
    each = open_.erase(each);
  }
  port->cancelled.clear();
  if (wakes)
    wake();
}

void scripted_service::accept(const std::shared_ptr<scripted_port>& port, std::int64_t now_ns) {
  for (auto& each : port->sent) {
    ++calls[(each.call.is_post ? "POST " : "GET ") + lane_of(each.call)];
    open_.push_back({port, each.number, std::move(each.call), now_ns, {.what = fault::none}, {}});
    open_.back().fault = take_fault(open_.back().call);
    int same = 0;
    for (const auto& other : open_)
      same += other.call.is_post && !other.port.expired() && lane_of(other.call) == lane_of(open_.back().call) &&
                      std::ranges::find(port->cancelled, other.number) == port->cancelled.end()
                  ? 1
                  : 0;
    at_once = std::max(at_once, same);
  }
  port->sent.clear();
}

planned_fault scripted_service::take_fault(const service_call& call) {
  for (auto& each : faults)
    if (each.times > 0 && call.target.find(each.where) != std::string::npos && !(each.posts_only && !call.is_post) &&
        !(each.gets_only && call.is_post)) {
      --each.times;
      return each;
    }
  return {.what = fault::none};
}

// True: it is answered.
bool scripted_service::advance(open_call& each, std::int64_t now_ns) {
  const auto age_ns = now_ns - each.sent_ns;
  const bool is_overdue = age_ns >= std::chrono::nanoseconds(each.call.total_timeout).count();
  switch (each.fault.what) {
  case fault::no_connection:
    each.answer = service_answer{.how = ending::not_reached, .error = "nobody listens there"};
    return age_ns >= latency_ns;
  case fault::wrong_host:
    each.answer = service_answer{.how = ending::misconfigured, .error = "the certificate is of another host"};
    return age_ns >= latency_ns;
  case fault::silence:
    each.answer = service_answer{.how = ending::not_reached, .error = "no byte came in time"};
    return is_overdue;
  case fault::status_answer:
    each.answer = problem(each.fault.status, "as the test wants it");
    if (each.fault.retry_after_ns != 0)
      each.answer->retry_after_ns = each.fault.retry_after_ns;
    return age_ns >= latency_ns;
  default:
    break;
  }
  if (!each.answer && age_ns >= latency_ns / 2) {
    const bool may_wait = age_ns < std::int64_t{30} * 1'000'000'000;
    each.answer = handle(each.call, may_wait);
    if (each.answer && each.fault.what == fault::lost_answer)
      each.answer = service_answer{.how = ending::not_reached, .error = "the connection was lost"};
    if (each.answer && each.fault.what == fault::cut_answer)
      each.answer->body.resize(each.answer->body.size() / 2);
  }
  return each.answer.has_value() && age_ns >= latency_ns;
}

// -- the contract ---------------------------------------------------------------------------------

std::optional<service_answer> scripted_service::next_of(const std::string& vehicle_id, bool may_wait) const {
  if (vehicle_id != vehicle)
    return problem(404, "no such vehicle");
  for (const auto& each : next_missions) {
    const auto found = missions.find(each);
    const bool has_ended = found != missions.end() && !found->second.reports.empty() &&
                           found->second.reports.back().kind == mission::progress_kind::complete;
    if (!has_ended)
      return plain(200, mission::to_text(mission::next_mission{answers_for.empty() ? vehicle_id : answers_for, each}));
  }
  return may_wait ? std::nullopt : std::optional(plain(204, ""));
}

std::optional<service_answer> scripted_service::handle(const service_call& call, bool may_wait) {
  const auto mark = call.target.find('?');
  const auto path = call.target.substr(0, mark);
  const auto query = mark == std::string::npos ? std::string() : call.target.substr(mark + 1);
  constexpr std::string_view vehicles = "/vehicles/";
  constexpr std::string_view next_call = "/missions/next";
  if (path.starts_with(vehicles) && path.ends_with(next_call))
    return next_of(path.substr(vehicles.size(), path.size() - vehicles.size() - next_call.size()), may_wait);
  constexpr std::size_t prefix = 10; // "/missions/"
  const auto id = path.substr(prefix, 36);
  const auto rest = path.size() > prefix + 36 ? path.substr(prefix + 36) : std::string();
  const auto found = missions.find(id);
  if (found == missions.end())
    return problem(404, "no such mission");
  auto& m = found->second;
  if (m.is_deleted)
    return problem(410, "deleted");
  if (!call.is_post) {
    if (rest.empty())
      return plain(200, mission::to_text(m.document));
    if (rest == "/progress")
      return plain(knows_progress_call ? 200 : 404, mission::to_text(progress_of(m)));
    if (rest != "/assignments")
      return page(m, rest, query);
    mission::assignment_list list;
    for (const auto& each : m.assignments)
      if (each.revision > std::stoi(parameter(query, "after")))
        list.assignments.push_back(each);
    if (list.assignments.empty() && may_wait)
      return std::nullopt;
    return plain(200, mission::to_text(list));
  }
  if (const auto known = kept_.find(call.key); known != kept_.end()) {
    if (known->second.body == call.body)
      return known->second.answer;
    ++other_bodies;
    return problem(422, "another body under a known key");
  }
  auto answer = handle_post(m, call, rest);
  kept_[call.key] = {call.body, answer};
  return answer;
}

service_answer scripted_service::handle_post(service_mission& m, const service_call& call, const std::string& rest) {
  if (rest == "/progress")
    return take_progress(m, call.body);
  if (rest == "/waypoints" || rest == "/tail")
    return take_change(m, call, rest == "/tail");
  if (rest == "/mapobjects" || rest == "/mapobjects/ignored")
    return take_map(m, call.body, rest != "/mapobjects");
  constexpr std::size_t prefix = 13; // "/assignments/"
  return take_response(m, rest.substr(prefix, 36), call.body);
}

// A mark is the number of a state of the map.
template <class Cut>
service_answer scripted_service::page_since(service_mission& m, const std::string& since, const Cut& cut) {
  if (!since.empty() && refuses_marks)
    return problem(400, "since is not known any more");
  if (m.marked.empty() || m.marked.back() != m.map_objects)
    m.marked.push_back(m.map_objects);
  mission::map_object_page result{"1.0.0", {}, {}};
  result.mark = std::to_string(m.marked.size() - 1);
  if (since.empty()) {
    cut(m.map_objects, result.map_objects, result.next);
    return plain(200, mission::to_text(result));
  }
  result.since = since;
  result.removed.emplace();
  const auto& before = m.marked.at(std::stoul(since));
  std::vector<mission::map_object> changed;
  for (const auto& each : m.map_objects)
    if (std::ranges::find(before, each) == before.end())
      changed.push_back(each);
  for (const auto& each : before)
    if (std::ranges::find(m.map_objects, each.object_id, &mission::map_object::object_id) == m.map_objects.end())
      result.removed->push_back(each.object_id);
  cut(changed, result.map_objects, result.next);
  if (result.next) // with the last page
    result.removed.reset();
  return plain(200, mission::to_text(result));
}

service_answer scripted_service::page(service_mission& m, const std::string& rest, const std::string& query) {
  const auto token = parameter(query, "next");
  if (!token.empty() && !std::exchange(page_tokens_, true))
    return problem(400, "next is not known any more");
  const auto from = token.empty() ? std::size_t{0} : static_cast<std::size_t>(std::stoul(token.substr(3))); // "%2B"
  const auto limit = std::min<std::size_t>(page_rows, std::stoul(parameter(query, "limit")));
  const auto cut = [&](const auto& all, auto& rows, auto& next) {
    const auto upto = std::min(all.size(), from + limit);
    rows.assign(all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(upto));
    if (upto < all.size())
      next = "+" + std::to_string(upto);
  };
  if (rest == "/mapobjects") {
    if (query.find("&since=") != std::string::npos)
      return page_since(m, parameter(query, "since"), cut);
    mission::map_object_page result{"1.0.0", {}, {}};
    cut(m.map_objects, result.map_objects, result.next);
    return plain(200, mission::to_text(result));
  }
  mission::ignored_item_page result{"1.0.0", {}, {}};
  cut(m.map_ignored, result.ignored_items, result.next);
  return plain(200, mission::to_text(result));
}

void scripted_service::note_items(service_mission& m) {
  for (const auto& each : m.document.items)
    m.item_ids.insert(mission::id_of(each));
}

service_answer scripted_service::take_progress(service_mission& m, const std::string& body) {
  const auto batch = mission::read<mission::progress_batch>(body);
  if (!batch)
    return problem(422, "the batch is wrong");
  note_items(m); // tests put items into the document as well
  auto reports = m.reports;
  std::uint32_t repeated = 0;
  for (const auto& each : batch->reports) {
    if (each.report_no <= reports.size()) {
      ++repeated;
      continue;
    }
    if (each.report_no != reports.size() + 1)
      return problem(409, "a gap");
    if (each.item_id && !m.item_ids.contains(*each.item_id)) {
      ++unknown_items;
      return problem(422, "an item that the mission never had");
    }
    reports.push_back(each);
  }
  const auto stored = static_cast<std::uint32_t>(reports.size() - m.reports.size());
  m.reports = std::move(reports);
  repeated_rows += repeated;
  return receipt(stored, repeated);
}

service_answer scripted_service::take_change(service_mission& m, const service_call& call, bool is_tail) {
  std::int32_t base = 0;
  std::optional<std::string> after;
  std::vector<mission::item> items;
  if (is_tail) {
    const auto wanted = mission::read<mission::tail>(call.body);
    if (!wanted)
      return problem(422, "the tail is wrong");
    base = wanted->base_revision;
    after = wanted->after_item_id;
    items = wanted->items;
  } else {
    const auto wanted = mission::read<mission::waypoint_insert>(call.body);
    if (!wanted)
      return problem(422, "the waypoint is wrong");
    base = wanted->base_revision;
    after = wanted->after_item_id;
    items = {wanted->waypoint};
  }
  const auto at = behind(m.document, after);
  if (base != m.document.revision || !at)
    return problem(409, "meant for another revision");
  auto& all = m.document.items;
  const auto place = all.begin() + static_cast<std::ptrdiff_t>(*at);
  all.insert(is_tail ? all.erase(place, all.end()) : place, items.begin(), items.end());
  m.document.revision += numbers_by;
  ++m.changes;
  note_items(m);
  return plain(200, mission::to_text(m.document));
}

service_answer scripted_service::take_response(service_mission& m, const std::string& id, const std::string& body) {
  const auto response = mission::read<mission::assignment_response>(body);
  if (!response)
    return problem(422, "the response is wrong");
  const auto found = std::ranges::find(m.assignments, id, &mission::assignment::assignment_id);
  if (found == m.assignments.end())
    return problem(409, "there is an outcome already");
  if (response->outcome == mission::assignment_outcome::accepted)
    m.document.revision = std::max(m.document.revision, found->revision);
  m.responses[id] = *response;
  m.assignments.erase(found);
  return receipt(1, 0);
}

service_answer scripted_service::take_map(service_mission& m, const std::string& body, bool is_ignored) {
  std::uint32_t stored = 0;
  std::uint32_t repeated = 0;
  if (is_ignored) {
    const auto batch = mission::read<mission::ignored_item_batch>(body);
    if (!batch)
      return problem(422, "the batch is wrong");
    for (const auto& each : batch->ignored_items)
      ++(m.ignored.try_emplace(each.ignored_id, each).second ? stored : repeated);
  } else {
    const auto batch = mission::read<mission::observation_batch>(body);
    if (!batch)
      return problem(422, "the batch is wrong");
    for (const auto& each : batch->observations)
      if (poison.contains(each.observation_id))
        return problem(422, "this observation is wrong");
    for (const auto& each : batch->observations)
      ++(m.observations.try_emplace(each.observation_id, each).second ? stored : repeated);
  }
  repeated_rows += repeated;
  return receipt(stored, repeated);
}

// -- samples --------------------------------------------------------------------------------------

mission::document sample_mission(const std::string& id, int waypoints) {
  mission::document result;
  result.mission_id = id;
  result.items.emplace_back(mission::takeoff{"up", 40});
  for (int i = 1; i <= waypoints; ++i)
    result.items.emplace_back(mission::waypoint{"w" + std::to_string(i), {47.3977 + i * 0.001, 8.5456, 40}, 0, 2, {}});
  result.items.emplace_back(mission::return_home{"home"});
  result.return_point = {47.3977, 8.5456, 0};
  return result;
}

mission::assignment sample_assignment(const mission::document& base, int number) {
  const auto text = std::to_string(number);
  return {.assignment_id = uuid(static_cast<std::uint64_t>(number), 'b'),
          .base_revision = base.revision,
          .revision = base.revision + number,
          .replace_after_item_id = "w1",
          .items = {mission::waypoint{"n" + text, {47.4, 8.546, 45}, 0, 2, {}}, mission::return_home{"home-" + text}}};
}

std::string uuid(std::uint64_t number, char kind) {
  char text[40];
  (void)std::snprintf(text, sizeof text, "%c0000000-0000-4000-8000-%012llx", kind,
                      static_cast<unsigned long long>(number));
  return text;
}

} // namespace godwit::mission_client::test
