#include "programs/godwitd/control/request_handler.hpp"

#include <algorithm>
#include <utility>

#include "io/fields/json_text.hpp"

namespace godwit::control {

using nlohmann::json;
using runtime::ask_error;

namespace {

json no_points(const ask_error& why) {
  const bool does_not_run = why.code == runtime::ask_errc::not_taken;
  return {{"ok", false},
          {"error", does_not_run
                        ? "points of interest are not scanned for now: no mission with scanning is flown"
                        : "there is no answer: " + why.what + "; ask for the points before you send it again"}};
}

std::string words_of(const scan_controller::decide_point& decided) {
  return std::string(io::name_of(decided.says)) + " point " + std::to_string(decided.number);
}

json no_bridge(const ask_error& why) {
  return {{"ok", false}, {"error", "operator_bridge does not answer: " + why.what}};
}

// WHY: empty where there is nothing to complain of.
json with_error(json document, const std::string& why) {
  if (!document.at("ok").get<bool>())
    document["error"] = why;
  return document;
}

json on_the_ground() { return {{"ok", false}, {"error", "this godwitd runs on the ground: it flies nothing"}}; }

constexpr std::size_t max_name = 64; // bytes

operators::principal speaker(const control_request& asked) {
  return {asked.by.empty() ? std::string("somebody") : asked.by.substr(0, max_name), operators::role::engineer,
          std::string(operators::local_session)};
}

json json_of(const operator_bridge::command_answer& answer) {
  json result{{"ok", answer.verdict == operator_bridge::verdict::taken}, {"verdict", io::name_of(answer.verdict)}};
  if (!answer.reason.empty())
    result[answer.verdict == operator_bridge::verdict::taken ? "advice" : "error"] = answer.reason;
  if (!answer.state.empty())
    result["state"] = answer.state;
  return result;
}

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
  case request_kind::control:
    change_control(asked);
    return;
  case request_kind::audit:
    list_audit(asked);
    return;
  case request_kind::login:
    make_link(asked);
    return;
  case request_kind::sign:
    sign(asked);
    return;
  case request_kind::points:
    list_points(asked.ticket);
    return;
  case request_kind::decide_point:
    decide_point(asked);
    return;
  }
}

void request_handler::collect_status(std::uint64_t ticket) {
  auto& half = collecting_[ticket] = {{{"ok", true}}, 0};
  if (others_.port)
    half.document["port"] = others_.port->json();
  if (others_.run)
    collect(ticket, "run", *others_.run, ground_run::get_run{});
  if (others_.flight)
    collect(ticket, "flight", *others_.flight, executor::get_flight{});
  if (others_.missions)
    collect(ticket, "missions", *others_.missions, executor::get_missions{});
  if (others_.traffic)
    collect(ticket, "traffic", *others_.traffic, executor::get_traffic{});
  if (others_.health)
    collect(ticket, "health", *others_.health, health::get_health{});
  if (others_.failsafe_status)
    collect(ticket, "failsafe", *others_.failsafe_status, failsafe::get_failsafe_status{});
  if (others_.ground)
    collect(ticket, "ground", *others_.ground, ground_port::get_port{});
  if (others_.bridge)
    collect(ticket, "operators", *others_.bridge, operator_bridge::get_operators{});
  if (others_.sightings)
    collect(ticket, "sightings", *others_.sightings, sightings::get_sightings{});
  if (others_.points)
    collect_wanted(ticket, "points", *others_.points, scan_controller::get_points{}, "null");
  if (others_.eyes)
    collect_wanted(ticket, "eyes", *others_.eyes, movement_detector::get_eyes{}, R"({"is_closed": true})");
  if (others_.fleet)
    collect(ticket, "fleet", *others_.fleet, fleet_link::get_fleet{});
  collect(ticket, "actors", others_.guardian, runtime::get_children{});
  collect(ticket, "map", others_.store, mapobjects_store::get_map{});
  collect(ticket, "vehicle", others_.vehicle, vehicle_link::get_connection{});
  if (others_.client)
    collect(ticket, "service", others_.client, mission_client::get_service{});
}

template <class Handle, class Question>
void request_handler::collect(std::uint64_t ticket, const char* part, const Handle& who, Question question) {
  ++collecting_[ticket].missing;
  ask(
      who, answer_timeout, question,
      [this, ticket, part](const auto& answer) { put(ticket, part, json::parse(io::to_json(answer))); },
      [this, ticket, part](const ask_error& why) {
        put(ticket, part, {{"error", "there is no answer: " + why.what}});
      });
}

// That an actor is not wanted now is no error: then the part is RESTING.
template <class Handle, class Question>
void request_handler::collect_wanted(std::uint64_t ticket, const char* part, const Handle& who, Question question,
                                     const char* resting) {
  ++collecting_[ticket].missing;
  ask(
      who, answer_timeout, question,
      [this, ticket, part](const auto& answer) { put(ticket, part, json::parse(io::to_json(answer))); },
      [this, ticket, part, resting](const ask_error& why) {
        put(ticket, part,
            why.code == runtime::ask_errc::not_taken ? json::parse(resting)
                                                     : json{{"error", "there is no answer: " + why.what}});
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
      [this, asked](const mission_client::retry_answer& answer) {
        auto document = json::parse(io::to_json(answer));
        document["ok"] = answer.error.empty();
        note(asked, "outbox-retry", answer.error.empty(), answer.error);
        answer_with(asked.ticket, document);
      },
      [this, ticket = asked.ticket](const ask_error& why) {
        answer_with(ticket, {{"ok", false}, {"error", "mission_client does not answer: " + why.what + "; ask again"}});
      });
}

void request_handler::say(const control_request& asked) {
  if (asked.point != 0)
    return insert_at_point(asked);
  if (!others_.flight || !others_.bridge)
    return answer_with(asked.ticket, on_the_ground());
  const bool is_stop = operators::is_stop(asked.said.kind);
  const std::chrono::nanoseconds patience =
      is_stop ? std::chrono::nanoseconds(operator_bridge::stop_patience) : command_timeout;
  ask(
      *others_.bridge, patience,
      operator_bridge::operator_command{asked.id, asked.valid_until_ns, speaker(asked), asked.said},
      [this, ticket = asked.ticket](const operator_bridge::command_answer& answer) {
        answer_with(ticket, json_of(answer));
      },
      [this, asked, is_stop](const ask_error& why) {
        if (is_stop)
          say_directly(asked);
        else
          answer_with(asked.ticket, {{"ok", false},
                                     {"error", "operator_bridge does not answer: " + why.what +
                                                   "; ask for the status before you send it again. pause and "
                                                   "come-home go out all the same"}});
      });
}

void request_handler::say_directly(const control_request& asked) {
  pass_on<operators::answer>(asked, std::string(io::name_of(asked.said.kind)) + " past operator_bridge",
                             *others_.flight, asked.said,
                             [](const auto& answer) { return std::pair(answer.is_taken, answer.reason); });
}

// THEN(points) when they are there.
template <class Then>
void request_handler::ask_points(std::uint64_t ticket, Then then) {
  if (!others_.points)
    return answer_with(ticket, on_the_ground());
  ask(*others_.points, answer_timeout, scan_controller::get_points{}, then,
      [this, ticket](const ask_error& why) { answer_with(ticket, no_points(why)); });
}

void request_handler::list_points(std::uint64_t ticket) {
  ask_points(ticket, [this, ticket](const scan_controller::points& seen) {
    auto document = json::parse(io::to_json(seen));
    document["ok"] = true;
    answer_with(ticket, document);
  });
}

void request_handler::decide_point(const control_request& asked) {
  if (!others_.points || !others_.bridge)
    return answer_with(asked.ticket, on_the_ground());
  ask(
      *others_.bridge, answer_timeout, operator_bridge::ask_leave{speaker(asked), words_of(asked.decided)},
      [this, asked](const operator_bridge::leave& answer) {
        if (answer.verdict == operator_bridge::verdict::taken)
          pass_decision_on(asked);
        else
          answer_with(asked.ticket, json_of(operator_bridge::command_answer{answer.verdict, answer.reason}));
      },
      [this, ticket = asked.ticket](const ask_error& why) { answer_with(ticket, no_bridge(why)); });
}

void request_handler::pass_decision_on(const control_request& asked) {
  ask(
      *others_.points, answer_timeout, asked.decided,
      [this, asked](const scan_controller::decide_answer& answer) {
        note(asked, words_of(asked.decided), answer.is_taken, answer.reason);
        answer_with(asked.ticket, answer.is_taken ? json{{"ok", true}} : json{{"ok", false}, {"error", answer.reason}});
      },
      [this, asked](const ask_error& why) {
        note(asked, words_of(asked.decided), false, "there is no answer");
        answer_with(asked.ticket, no_points(why));
      });
}

// Only what a person has confirmed has a place to fly to; from there on it is a command like any other.
void request_handler::insert_at_point(const control_request& asked) {
  ask_points(asked.ticket, [this, asked](const scan_controller::points& seen) {
    const auto found = std::ranges::find(seen.confirmed, asked.point, &scan_controller::point_view::number);
    if (found == seen.confirmed.end())
      return answer_with(asked.ticket, {{"ok", false},
                                        {"error", "point " + std::to_string(asked.point) +
                                                      " is not confirmed; `godwitd ctl points` lists those that are"}});
    auto placed = asked;
    placed.point = 0;
    placed.said.place->latitude = found->position.latitude_deg;
    placed.said.place->longitude = found->position.longitude_deg;
    say(placed);
  });
}

void request_handler::override_rule(const control_request& asked) {
  auto wanted = asked.overridden;
  wanted.until_ns = wall_ns() + asked.lasts_s * 1'000'000'000;
  if (others_.failsafe)
    pass_on<failsafe::override_answer>(asked, "override " + std::string(io::name_of(wanted.scope)), *others_.failsafe,
                                       wanted,
                                       [](const auto& answer) { return std::pair(answer.taken, answer.reason); });
  else
    answer_with(asked.ticket, on_the_ground());
}

// The key goes from vehicle_link to the vehicle; here nobody has it.
void request_handler::sign(const control_request& asked) {
  if (!others_.bridge)
    return answer_with(asked.ticket, on_the_ground()); // nobody would keep who has said it
  pass_on<vehicle_link::signing_answer>(asked, asked.ends_signing ? "end signing" : "give the signing key",
                                        others_.vehicle, vehicle_link::set_up_signing{asked.ends_signing},
                                        [](const auto& answer) { return std::pair(answer.is_sent, answer.reason); });
}

// TAKEN_AND_WHY: of the answer.
template <class Answer, class Handle, class Question, class Reader>
void request_handler::pass_on(const control_request& asked, const std::string& what, const Handle& who,
                              const Question& question, Reader taken_and_why) {
  ask(
      who, answer_timeout, question,
      [this, asked, what, taken_and_why](const Answer& answer) {
        const auto [is_taken, reason] = taken_and_why(answer);
        json document{{"ok", is_taken}};
        if (!is_taken)
          document["error"] = reason;
        note(asked, what, is_taken, reason);
        answer_with(asked.ticket, document);
      },
      [this, asked, what](const ask_error& why) {
        note(asked, what, false, "there is no answer");
        answer_with(asked.ticket,
                    {{"ok", false},
                     {"error", "there is no answer: " + why.what + "; ask for the status before you send it again"}});
      });
}

// -- operators --------------------------------------------------------------------------------------

void request_handler::note(const control_request& asked, const std::string& what, bool is_done,
                           const std::string& reason) {
  if (others_.bridge)
    tell(*others_.bridge, operator_bridge::audit_note{speaker(asked), what, is_done ? "taken" : "refused", reason});
}

// JSON_OF: of the answer.
template <class Answer, class Question, class Writer>
void request_handler::ask_bridge(const control_request& asked, const Question& question, Writer json_of) {
  if (!others_.bridge)
    return answer_with(asked.ticket, on_the_ground());
  ask(
      *others_.bridge, answer_timeout, question,
      [this, ticket = asked.ticket, json_of](const Answer& answer) { answer_with(ticket, json_of(answer)); },
      [this, ticket = asked.ticket](const ask_error& why) { answer_with(ticket, no_bridge(why)); });
}

void request_handler::change_control(const control_request& asked) {
  ask_bridge<operator_bridge::control_answer>(
      asked, operator_bridge::change_control{speaker(asked), asked.act, asked.to}, [](const auto& answer) {
        return with_error({{"ok", answer.is_done}, {"holder", answer.holder}}, answer.reason);
      });
}

void request_handler::make_link(const control_request& asked) {
  ask_bridge<operator_bridge::link_answer>(
      asked, operator_bridge::make_link{speaker(asked), asked.key}, [](const auto& answer) {
        return with_error({{"ok", answer.is_made}, {"valid_until_ns", answer.valid_until_ns}}, answer.reason);
      });
}

void request_handler::list_audit(const control_request& asked) {
  if (!others_.bridge)
    return answer_with(asked.ticket, on_the_ground());
  ask(
      *others_.bridge, answer_timeout, operator_bridge::read_audit{speaker(asked)},
      [this, asked](const operator_bridge::audit_leave& answer) {
        if (!answer.refusal.empty())
          return answer_with(asked.ticket, {{"ok", false}, {"error", answer.refusal}});
        others_.read_audit({asked.before, asked.rows}, [answers = answers_, ticket = asked.ticket](const auto& page) {
          json document{{"ok", false}};
          if (page)
            document = json::parse(io::to_json(*page));
          else
            document["error"] = page.error();
          document["ok"] = page.has_value();
          answers->put({ticket, document.dump(-1, ' ', false, json::error_handler_t::replace)});
        });
      },
      [this, ticket = asked.ticket](const ask_error& why) { answer_with(ticket, no_bridge(why)); });
}

void request_handler::crash(const control_request& asked) {
  if (!others_.crash)
    answer_with(asked.ticket, {{"ok", false}, {"error", "crashes are for drills: start godwitd with --allow-crash"}});
  else if (!others_.crash(asked.key))
    answer_with(asked.ticket, {{"ok", false}, {"error", "no actor \"" + asked.key + "\" runs"}});
  else {
    note(asked, "crash " + asked.key, true, {});
    answer_with(asked.ticket, {{"ok", true}});
  }
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
