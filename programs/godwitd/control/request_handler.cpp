#include "programs/godwitd/control/request_handler.hpp"

#include <utility>

#include "io/fields/json_text.hpp"

namespace godwit::control {

using nlohmann::json;
using runtime::ask_error;

namespace {

json on_the_ground() { return {{"ok", false}, {"error", "this godwitd runs on the ground: it flies nothing"}}; }

} // namespace

request_handler::request_handler(runtime::spawn_context context, peers others, std::shared_ptr<response_queue> answers)
    : actor_base(std::move(context)), others_(std::move(others)), answers_(std::move(answers)) {}

request_handler::~request_handler() = default;

request_handler::behavior_type request_handler::handlers() {
  return {on<control_request>([this](const control_request& m) { take(m); })};
}

void request_handler::take(const control_request& asked) {
  switch (asked.what) {
  case request_kind::status:
    collect_status(asked.ticket);
    return;
  case request_kind::outbox_retry:
    retry(asked);
    return;
  case request_kind::command:
    say(asked);
    return;
  case request_kind::override_rule:
    override_rule(asked);
    return;
  case request_kind::crash:
    crash(asked);
    return;
  case request_kind::rescue_journal:
    rescue_journal(asked);
    return;
  }
}

void request_handler::collect_status(std::uint64_t ticket) {
  auto& half = collecting_[ticket] = {{{"ok", true}}, 3};
  half.missing += (others_.run ? 1 : 0) + (others_.flight ? 1 : 0) + (others_.ground ? 1 : 0) +
                  (others_.sightings ? 1 : 0) + (others_.client ? 1 : 0) + (others_.failsafe_status ? 1 : 0) +
                  (others_.health ? 1 : 0);
  if (others_.run)
    collect(ticket, "run", *others_.run, ground_run::get_run{});
  if (others_.flight)
    collect(ticket, "flight", *others_.flight, executor::get_flight{});
  if (others_.health)
    collect(ticket, "health", *others_.health, health::get_health{});
  if (others_.failsafe_status)
    collect(ticket, "failsafe", *others_.failsafe_status, failsafe::get_failsafe_status{});
  if (others_.ground)
    collect(ticket, "ground", *others_.ground, ground_port::get_port{});
  if (others_.sightings)
    collect(ticket, "sightings", *others_.sightings, sightings::get_sightings{});
  collect(ticket, "actors", others_.guardian, runtime::get_children{});
  collect(ticket, "map", others_.store, mapobjects_store::get_map{});
  collect(ticket, "vehicle", others_.vehicle, vehicle_link::get_connection{});
  if (others_.client)
    collect(ticket, "service", others_.client, mission_client::get_service{});
}

template <class Handle, class Question>
void request_handler::collect(std::uint64_t ticket, const char* part, const Handle& who, Question question) {
  ask(
      who, answer_timeout, question,
      [this, ticket, part](const auto& answer) { put(ticket, part, json::parse(io::to_json(answer))); },
      [this, ticket, part](const ask_error& why) {
        put(ticket, part, {{"error", "there is no answer: " + why.what}});
      });
}

void request_handler::put(std::uint64_t ticket, const char* part, json what) {
  const auto found = collecting_.find(ticket);
  if (found == collecting_.end())
    return;
  found->second.document[part] = std::move(what);
  if (--found->second.missing != 0)
    return;
  answer_with(ticket, found->second.document);
  collecting_.erase(found);
}

void request_handler::retry(const control_request& asked) {
  if (!others_.client) {
    answer_with(asked.ticket, {{"ok", false},
                               {"error", "this godwitd has its mission from a file: it owes nothing to "
                                         "a service"}});
    return;
  }
  ask(
      others_.client, answer_timeout, mission_client::retry_outbox{asked.key},
      [this, ticket = asked.ticket](const mission_client::retry_answer& answer) {
        auto document = json::parse(io::to_json(answer));
        document["ok"] = answer.error.empty();
        answer_with(ticket, document);
      },
      [this, ticket = asked.ticket](const ask_error& why) {
        answer_with(ticket, {{"ok", false}, {"error", "mission_client does not answer: " + why.what + "; ask again"}});
      });
}

void request_handler::say(const control_request& asked) {
  if (others_.flight)
    pass_on<operators::answer>(asked.ticket, *others_.flight, asked.said,
                               [](const auto& answer) { return std::pair(answer.is_taken, answer.reason); });
  else
    answer_with(asked.ticket, on_the_ground());
}

void request_handler::override_rule(const control_request& asked) {
  auto wanted = asked.overridden;
  wanted.until_ns = wall_ns() + asked.lasts_s * 1'000'000'000;
  if (others_.failsafe)
    pass_on<failsafe::override_answer>(asked.ticket, *others_.failsafe, wanted,
                                       [](const auto& answer) { return std::pair(answer.taken, answer.reason); });
  else
    answer_with(asked.ticket, on_the_ground());
}

// TAKEN_AND_WHY: of the answer.
template <class Answer, class Handle, class Question, class Reader>
void request_handler::pass_on(std::uint64_t ticket, const Handle& who, const Question& question, Reader taken_and_why) {
  ask(
      who, answer_timeout, question,
      [this, ticket, taken_and_why](const Answer& answer) {
        const auto [is_taken, reason] = taken_and_why(answer);
        json document{{"ok", is_taken}};
        if (!is_taken)
          document["error"] = reason;
        answer_with(ticket, document);
      },
      [this, ticket](const ask_error& why) {
        answer_with(ticket,
                    {{"ok", false},
                     {"error", "there is no answer: " + why.what + "; ask for the status before you say it again"}});
      });
}

void request_handler::crash(const control_request& asked) {
  if (!others_.crash)
    answer_with(asked.ticket, {{"ok", false}, {"error", "crashes are for drills: start godwitd with --allow-crash"}});
  else if (!others_.crash(asked.key))
    answer_with(asked.ticket, {{"ok", false}, {"error", "no actor \"" + asked.key + "\" runs"}});
  else
    answer_with(asked.ticket, {{"ok", true}});
}

// The journal's own thread answers.
void request_handler::rescue_journal(const control_request& asked) {
  if (!others_.rescue_journal) {
    answer_with(asked.ticket, {{"ok", false}, {"error", "this godwitd has no journal in a file"}});
    return;
  }
  others_.rescue_journal(
      [answers = answers_, ticket = asked.ticket](const tl::expected<std::string, std::string>& done) {
        const json document = done ? json{{"ok", true}, {"file", *done}} : json{{"ok", false}, {"error", done.error()}};
        answers->put({ticket, document.dump(-1, ' ', false, json::error_handler_t::replace)});
      });
}

void request_handler::answer_with(std::uint64_t ticket, const json& document) {
  answers_->put({ticket, document.dump(-1, ' ', false, json::error_handler_t::replace)});
}

} // namespace godwit::control
