#include "programs/godwitd/operator_port/mission_handler.hpp"

#include <utility>

#include "programs/godwitd/operator_port/api_answers.hpp"

namespace godwit::operator_port {

using operator_bridge::verdict;
using operators::principal;

mission_handler::mission_handler(runtime::spawn_context context, mission_peers others,
                                 std::shared_ptr<waiting_answers> answers, std::string why_not)
    : actor_base(std::move(context)), others_(std::move(others)), answers_(std::move(answers)),
      why_not_(std::move(why_not)) {}

mission_handler::~mission_handler() = default;

mission_handler::behavior_type mission_handler::handlers() {
  return {on<mission_upload>([this](const mission_upload& m) { take(std::make_shared<const mission_upload>(m)); })};
}

template <class Handle, class Question, class OnAnswer>
void mission_handler::ask_about(const mission_upload& asked, const Handle& whom, Question question,
                                OnAnswer on_answer) {
  ask(whom, answer_timeout, std::move(question), std::move(on_answer),
      [this, ticket = asked.ticket](const runtime::ask_error& why) {
        answers_->resolve(ticket, problem(504, "the mission was not taken: nobody answers (" + why.what + ")"));
      });
}

void mission_handler::take(const upload_ptr& asked) {
  ask_about(*asked, others_.bridge, operator_bridge::identify{asked->token_hash},
            [this, asked](const operator_bridge::identity& who) {
              if (!who.is_known)
                return refuse(*asked, {}, verdict::no_session, "log in first: there is no session, or it is over");
              if (who.who.role == operators::role::viewer)
                return refuse(*asked, who.who, verdict::wrong_role, "a viewer may not upload a mission");
              if (!why_not_.empty())
                return refuse(*asked, who.who, verdict::refused, why_not_);
              look_at_control(asked, who.who);
            });
}

void mission_handler::look_at_control(const upload_ptr& asked, const principal& who) {
  ask_about(*asked, others_.bridge, operator_bridge::get_operators{},
            [this, asked, who](const operator_bridge::operators_view& view) {
              if (!view.control)
                return refuse(*asked, who, verdict::no_control, "nobody has control: take it first");
              if (view.control->who != who)
                return refuse(*asked, who, verdict::no_control, view.control->who.name + " has control");
              look_at_flight(asked, who);
            });
}

void mission_handler::look_at_flight(const upload_ptr& asked, const principal& who) {
  ask_about(*asked, others_.flight, executor::get_flight{}, [this, asked, who](const executor::flight_status& flight) {
    if (flight.in_flight)
      return refuse(*asked, who, verdict::refused, "a flight is under way; another mission is taken on the ground");
    if (!flight.why_no_mission.empty())
      return refuse(*asked, who, verdict::refused, flight.why_no_mission);
    hand_over(asked, who);
  });
}

// Were it to take off in between: the mission has another id, and waits until that flight is over.
void mission_handler::hand_over(const upload_ptr& asked, const principal& who) {
  mission_client::mission_loaded loaded;
  loaded.cause = mission_client::load_cause::brought;
  loaded.document = asked->mission;
  tell(others_.missions, loaded);
  const auto& id = asked->mission.mission_id;
  const auto items = asked->mission.items.size();
  tell(others_.bridge, operator_bridge::audit_note{who, "mission " + id, "done", std::to_string(items) + " items"});
  answers_->resolve(asked->ticket, json_answer(200, {{"mission_id", id}, {"items", items}}));
}

void mission_handler::refuse(const mission_upload& asked, const principal& who, verdict why,
                             const std::string& sentence) {
  tell(others_.bridge, operator_bridge::audit_note{who, "mission", std::string(io::name_of(why)), sentence});
  answers_->resolve(asked.ticket, answer_of({}, operator_bridge::command_answer{why, sentence}));
}

} // namespace godwit::operator_port
