#include "programs/godwit-drill/flight_simulation/simulated_service.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "io/http/message.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"
#include "runtime/assert.hpp"

namespace godwit::drill {
namespace {

namespace missions = sim::missions;
using mission_client::ending;
using mission_client::service_answer;

constexpr const char* token = "secret";

std::unique_ptr<missions::service_file> new_file() {
  auto opened = missions::service_file::open(":memory:");
  GODWIT_ASSERT(opened.has_value(), "drill: a database in memory opens");
  return *std::move(opened);
}

missions::request request_of(const mission_client::service_call& call) {
  return {call.is_post ? "POST" : "GET", call.target, std::string("Bearer ") + token,
          std::string(call.is_post ? missions::json_type : ""), call.body};
}

// As the client's HTTP makes it of what came over the wire.
service_answer answer_of(std::uint64_t number, const missions::delivery& came, std::size_t max_bytes) {
  if (came.is_lost || came.cut_after)
    return {.number = number, .how = ending::not_reached, .error = "the connection was reset"};
  if (came.what.body.size() + came.padding > max_bytes)
    return {.number = number, .how = ending::bad_answer, .error = "the answer is too long"};
  const bool is_json = io::http::has_content_type(came.what.content_type, missions::json_type);
  if (came.what.status == 200 && !is_json)
    return {.number = number, .how = ending::bad_answer, .error = "the answer is no JSON"};
  service_answer result{.number = number, .status = came.what.status, .body = came.what.body};
  for (const auto& [name, text] : came.what.headers)
    if (name == "Retry-After")
      result.retry_after_ns = std::stoll(text) * 1'000'000'000;
  return result;
}

} // namespace

simulated_service::simulated_service(std::int64_t wall_began_ns)
    : wall_began_ns_(wall_began_ns), file_(new_file()), service_(*file_, {.vehicle = token, .foreign = ""}),
      faulty_(service_, faults_) {}

// -- calls ------------------------------------------------------------------------------------------

bool simulated_service::take_from(const std::shared_ptr<simulated_service_port>& port, std::int64_t now_ns) {
  const auto sent = port->take_sent();
  for (const auto& each : sent)
    open_.push_back({port, each.number, faulty_.take(request_of(each.what)), each.what.max_answer_bytes,
                     now_ns + std::chrono::nanoseconds(each.what.total_timeout).count(), stage::on_its_way,
                     now_ns + latency_ns / 2});
  for (const auto number : port->take_cancelled())
    for (auto& each : open_)
      if (each.number == number && each.port.lock() == port)
        each.port.reset(); // what it does is done all the same
  return !sent.empty();
}

std::int64_t simulated_service::next_deadline_ns() const {
  auto next = never_ns;
  for (const auto& each : open_)
    next = std::min(next, each.due_ns);
  return next;
}

void simulated_service::on_time(std::int64_t now_ns) {
  for (auto& each : open_)
    if (each.due_ns <= now_ns)
      advance(each, now_ns);
  std::erase_if(open_, [](const open_call& each) { return each.due_ns == never_ns; });
}

void simulated_service::advance(open_call& each, std::int64_t now_ns) {
  if (is_cut(now_ns) && now_ns < each.gives_up_ns)
    return lose(each, now_ns);
  switch (each.at) {
  case stage::on_its_way:
    return answer(each, now_ns, missions::patience::some);
  case stage::held:
    if (each.port.expired())
      each.due_ns = never_ns;
    else
      answer(each, now_ns, missions::patience::none);
    return;
  case stage::answered:
    deliver(each);
    each.due_ns = never_ns;
  }
}

// What was on the wire is gone; what the service has done with it is done.
void simulated_service::lose(open_call& each, std::int64_t now_ns) {
  each.at = stage::answered;
  each.answer.emplace();
  each.answer->is_lost = true;
  each.due_ns = std::max(each.gives_up_ns, now_ns);
}

void simulated_service::answer(open_call& each, std::int64_t now_ns, missions::patience how_long) {
  auto given = faulty_.answer_to(each.asked, wall_began_ns_ + now_ns, how_long);
  if (const auto* poll = std::get_if<missions::waiting>(&given)) {
    each.at = stage::held;
    each.due_ns = now_ns + static_cast<std::int64_t>(poll->wait_s) * 1'000'000'000;
    return;
  }
  each.at = stage::answered;
  each.answer = std::get<missions::delivery>(std::move(given));
  each.due_ns = now_ns + latency_ns / 2 + each.answer->delay.count();
  if (each.due_ns > each.gives_up_ns) {
    each.due_ns = std::max(each.gives_up_ns, now_ns);
    each.answer->is_lost = true;
  }
}

void simulated_service::deliver(const open_call& each) {
  if (const auto port = each.port.lock())
    port->put(answer_of(each.number, *each.answer, each.max_answer_bytes));
}

// -- its people -------------------------------------------------------------------------------------

void simulated_service::add_mission(const mission::document& what) {
  const auto added = missions::service_operations::add_mission(*file_, what);
  GODWIT_ASSERT(added.has_value(), "drill: the mission is a good one");
}

void simulated_service::add_mission(const mission::document& what, std::int64_t now_ns) {
  add_mission(what);
  answer_polls(now_ns);
}

// They have their news.
void simulated_service::answer_polls(std::int64_t now_ns) {
  for (auto& each : open_)
    if (each.at == stage::held)
      answer(each, now_ns, missions::patience::some);
}

void simulated_service::set_map_objects(const std::string& mission_id,
                                        const std::vector<mission::map_object>& objects) {
  const auto set = missions::service_operations::set_map_objects(*file_, mission_id, objects);
  GODWIT_ASSERT(set.has_value(), "drill: the objects are good ones");
}

bool simulated_service::assign(const std::string& mission_id, const missions::assignment_request& wanted,
                               std::int64_t now_ns) {
  if (!missions::service_operations::assign(*file_, mission_id, wanted, ++assigned_))
    return false;
  answer_polls(now_ns);
  return true;
}

void simulated_service::revise(const std::string& mission_id, const mission::item& extra) {
  auto changed = mission(mission_id);
  changed.items.insert(changed.items.end() - 1, extra);
  ++changed.revision;
  const auto reused = missions::note_items(*file_, mission_id, changed.items, "/items");
  GODWIT_ASSERT(reused.empty(), "drill: the item is a new one");
  missions::replace_mission(*file_, changed);
}

void simulated_service::set_fault(std::string_view words) {
  const auto added = faults_.add(words);
  GODWIT_ASSERT(added.has_value(), "drill: the words of the fault are right");
}

// -- what it has ------------------------------------------------------------------------------------

mission::document simulated_service::mission(const std::string& mission_id) {
  return missions::stored_mission(*file_, mission_id);
}

std::vector<missions::stored_row> simulated_service::rows(const std::string& mission_id, missions::row_kind kind) {
  return missions::rows_of(*file_, mission_id, kind);
}

std::uint64_t simulated_service::answers_to_reports(unsigned status) const {
  missions::service_figures figures;
  faulty_.count_into(figures);
  return figures.answers[missions::endpoint::post_progress][status];
}

missions::row_figures simulated_service::figures(missions::row_kind kind) { return missions::row_counts(*file_)[kind]; }

} // namespace godwit::drill
