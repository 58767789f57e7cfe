#include "programs/godwitd/operator_port/view_handler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/fields/json_text.hpp"
#include "io/text.hpp"
#include "programs/godwitd/operator_port/api_answers.hpp"

namespace godwit::operator_port {
namespace {

constexpr std::int64_t ns_a_ms = 1'000'000;
constexpr const char* query_rule = "Ask with ?bbox=WEST,SOUTH,EAST,NORTH in degrees and &limit=N, or without.";

// What TEXT begins with up to END, which is taken off with it.
std::string_view take_until(std::string_view& text, char end) {
  const auto at = std::min(text.find(end), text.size());
  const auto result = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return result;
}

bool read_part(std::string_view text, mapobjects_store::map_part& part) {
  std::array<double, 4> degrees{};
  for (auto& each : degrees)
    if (!io::read_number(take_until(text, ','), each) || !std::isfinite(each))
      return false;
  part = {degrees[0], degrees[1], degrees[2], degrees[3]};
  const bool is_on_earth =
      std::abs(part.west_deg) <= 180 && std::abs(part.east_deg) <= 180 && part.south_deg >= -90 && part.north_deg <= 90;
  return text.empty() && is_on_earth && part.south_deg <= part.north_deg;
}

objects_on_map described(const mapobjects_store::shown_objects& seen) {
  objects_on_map result{{}, seen.counted, seen.is_all};
  for (const auto& each : seen.list)
    result.objects.push_back({each.class_group, each.position.latitude_deg, each.position.longitude_deg,
                              each.confidence, each.last_seen_ns / ns_a_ms, each.is_seen_here});
  return result;
}

} // namespace

tl::expected<mapobjects_store::get_objects, std::string> read_objects_query(std::string_view target) {
  mapobjects_store::get_objects result;
  auto query = target.substr(std::min(target.find('?'), target.size()));
  query.remove_prefix(std::min<std::size_t>(1, query.size()));
  while (!query.empty()) {
    auto value = take_until(query, '&');
    const auto name = take_until(value, '=');
    const bool is_read = name == "bbox"    ? read_part(value, result.within)
                         : name == "limit" ? io::read_number(value, result.limit) && result.limit > 0
                                           : false;
    if (!is_read)
      return tl::make_unexpected(std::string(query_rule));
  }
  return result;
}

view_handler::view_handler(runtime::spawn_context context, executor::view_handle flight,
                           mapobjects_store::viewer_handle map, std::shared_ptr<waiting_answers> answers)
    : actor_base(std::move(context)), flight_(std::move(flight)), map_(std::move(map)), answers_(std::move(answers)) {}

view_handler::~view_handler() = default;

view_handler::behavior_type view_handler::handlers() {
  return {on<view_request>([this](const view_request& m) {
    switch (m.what) {
    case view_kind::plan:
      return show<executor::get_plan, executor::plan_view>(m.ticket);
    case view_kind::preflight:
      return show<executor::get_preflight, executor::preflight_view>(m.ticket);
    case view_kind::objects:
      return show_objects(m);
    }
  })};
}

template <class Question, class View>
void view_handler::show(std::uint64_t ticket) {
  ask(
      flight_, answer_timeout, Question{},
      [this, ticket](const View& view) { answers_->resolve(ticket, {.body = io::to_json(view)}); },
      [this, ticket](const runtime::ask_error& why) {
        const bool was_not_taken = why.code == runtime::ask_errc::not_taken;
        answers_->resolve(ticket, problem(was_not_taken ? 503 : 504, "the executor does not answer: " + why.what));
      });
}

void view_handler::show_objects(const view_request& asked) {
  ask(
      map_, answer_timeout, asked.objects,
      [this, ticket = asked.ticket](const mapobjects_store::shown_objects& seen) {
        if (seen.failure == mapobjects_store::map_failure::none)
          answers_->resolve(ticket, {.body = io::to_json(described(seen))});
        else
          answers_->resolve(ticket, problem(503, "the map can not be read: " + seen.error));
      },
      [this, ticket = asked.ticket](const runtime::ask_error& why) {
        const bool was_not_taken = why.code == runtime::ask_errc::not_taken;
        answers_->resolve(ticket, problem(was_not_taken ? 503 : 504, "the map does not answer: " + why.what));
      });
}

route_list view_routes(const std::shared_ptr<waiting_answers>& answers,
                       const std::function<void(view_request asked)>& tell) {
  const auto shows = [answers, tell](view_kind what) {
    return [answers, tell, what](const server_request&, responder answer) {
      if (const auto ticket = answers->add(std::move(answer)))
        tell({*ticket, what});
    };
  };
  const auto shows_objects = [answers, tell](const server_request& asked, responder answer) {
    const auto wanted = read_objects_query(asked.target);
    if (!wanted)
      return answer.send(problem(400, wanted.error()));
    if (const auto ticket = answers->add(std::move(answer)))
      tell({*ticket, view_kind::objects, *wanted});
  };
  return {{"GET", "/api/v1/plan", 0, shows(view_kind::plan)},
          {"GET", "/api/v1/preflight", 0, shows(view_kind::preflight)},
          {"GET", "/api/v1/map/objects", 0, shows_objects}};
}

} // namespace godwit::operator_port
