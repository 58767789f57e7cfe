#include "programs/godwitd/operator_port/view_desk.hpp"

#include <utility>

#include "io/fields/json_text.hpp"
#include "programs/godwitd/operator_port/api_answers.hpp"

namespace godwit::operator_port {

view_desk::view_desk(runtime::spawn_context context, executor::view_handle flight,
                     std::shared_ptr<waiting_answers> answers)
    : actor_base(std::move(context)), flight_(std::move(flight)), answers_(std::move(answers)) {}

view_desk::~view_desk() = default;

view_desk::behavior_type view_desk::handlers() {
  return {on<view_request>([this](const view_request& m) {
    if (m.what == view_kind::plan)
      show<executor::get_plan, executor::plan_view>(m.ticket);
    else
      show<executor::get_preflight, executor::preflight_view>(m.ticket);
  })};
}

template <class Question, class View>
void view_desk::show(std::uint64_t ticket) {
  ask(
      flight_, answer_timeout, Question{},
      [this, ticket](const View& view) { answers_->resolve(ticket, {.body = io::to_json(view)}); },
      [this, ticket](const runtime::ask_error& why) {
        const bool was_not_taken = why.code == runtime::ask_errc::not_taken;
        answers_->resolve(ticket, problem(was_not_taken ? 503 : 504, "the executor does not answer: " + why.what));
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
  return {{"GET", "/api/v1/plan", 0, shows(view_kind::plan)},
          {"GET", "/api/v1/preflight", 0, shows(view_kind::preflight)}};
}

} // namespace godwit::operator_port
