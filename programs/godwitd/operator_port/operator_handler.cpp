#include "programs/godwitd/operator_port/operator_handler.hpp"

#include <utility>

#include "programs/godwitd/operator_port/api_answers.hpp"

namespace godwit::operator_port {

using operator_bridge::verdict;
using operators::principal;

namespace {

bool is_stop(const api_request& asked) {
  return asked.what == api_act::command && operators::is_stop(asked.said.what.kind);
}

bool is_over(const operator_bridge::identity& each, std::int64_t now_ns) {
  return each.ends_ns != 0 && each.ends_ns <= now_ns;
}

} // namespace

operator_handler::operator_handler(runtime::spawn_context context, handler_peers others,
                                   std::shared_ptr<waiting_answers> answers)
    : actor_base(std::move(context)), others_(std::move(others)), answers_(std::move(answers)) {}

operator_handler::~operator_handler() = default;

operator_handler::behavior_type operator_handler::handlers() {
  return {on<api_request>([this](const api_request& m) { take(m); })};
}

void operator_handler::take(const api_request& asked) {
  switch (asked.what) {
  case api_act::open_session:
    return ask_bridge(asked, answer_timeout,
                      operator_bridge::open_session{asked.account, asked.new_token_hash, asked.from},
                      [this, asked](const operator_bridge::session_answer& answer) { opened(asked, answer); });
  case api_act::use_link:
    return ask_bridge(asked, answer_timeout,
                      operator_bridge::use_link{asked.link_hash, asked.new_token_hash, asked.from},
                      [this, asked](const operator_bridge::session_answer& answer) { opened(asked, answer); });
  case api_act::refuse_login:
    return note_stranger(asked, "log in from " + asked.from, "wrong_password");
  case api_act::refuse_origin:
    return note_stranger(asked, "a page of another site", "cross_origin");
  default:
    return identify(asked);
  }
}

template <class Question, class OnAnswer>
void operator_handler::ask_bridge(const api_request& asked, std::chrono::milliseconds patience, Question question,
                                  OnAnswer on_answer) {
  if (is_stop(asked))
    patience = operator_bridge::stop_patience;
  ask(others_.bridge, patience, std::move(question), std::move(on_answer),
      [this, asked, ticket = asked.ticket](const runtime::ask_error& why) {
        if (may_stop(asked))
          return stop_directly(asked);
        const bool was_not_taken = why.code == runtime::ask_errc::not_taken;
        answers_->resolve(ticket, problem(was_not_taken ? 503 : 504, "operator_bridge does not answer: " + why.what +
                                                                         "; hold and return go out with godwitd ctl"));
      });
}

void operator_handler::identify(const api_request& asked) {
  ask_bridge(asked, answer_timeout, operator_bridge::identify{asked.token_hash},
             [this, asked](const operator_bridge::identity& who) {
               remember(asked.token_hash, who);
               if (who.is_known) {
                 answers_->prove(asked.ticket, who.who.session);
                 return take_known(asked, who);
               }
               if (asked.what != api_act::look)
                 note_stranger(asked, std::string(io::name_of(asked.what)) + " from " + asked.from, "no_session");
               answers_->resolve(asked.ticket, problem(401, "log in first: there is no session, or it is over"));
             });
}

void operator_handler::remember(const std::string& token_hash, const operator_bridge::identity& who) {
  if (!who.is_known) {
    identified_.erase(token_hash);
    return;
  }
  if (identified_.size() == max_identified)
    std::erase_if(identified_, [now_ns = wall_ns()](const auto& each) { return is_over(each.second, now_ns); });
  if (identified_.size() < max_identified || identified_.contains(token_hash))
    identified_.insert_or_assign(token_hash, who);
}

// operator_bridge would let each operator hold the vehicle and bring it home; it does not answer.
bool operator_handler::may_stop(const api_request& asked) {
  const auto found = identified_.find(asked.token_hash);
  return is_stop(asked) && found != identified_.end() && found->second.who.role >= operators::role::operator_ &&
         !is_over(found->second, wall_ns());
}

void operator_handler::stop_directly(const api_request& asked) {
  const auto who = identified_.at(asked.token_hash).who;
  auto said = asked.said.what;
  said.by = who.name;
  const auto what = std::string(io::name_of(said.kind)) + " past operator_bridge";
  const auto end = [this, asked, who, what](const operator_bridge::command_answer& answer) {
    answer_and_note(asked, who, what, answer);
  };
  if (const auto until_ns = asked.said.valid_until_ns;
      said.kind != operators::command_kind::pause && until_ns != 0 && wall_ns() > until_ns)
    return end({verdict::late, "its time had passed before it could be sent; repeat the command"});
  ask(
      others_.flight, answer_timeout, said,
      [end](const operators::answer& answer) {
        end({answer.is_taken ? verdict::taken : verdict::refused, answer.reason});
      },
      [end](const runtime::ask_error&) {
        end({verdict::unknown, "the executor does not answer; look at the vehicle, and repeat the command"});
      });
}

void operator_handler::take_known(const api_request& asked, const operator_bridge::identity& who) {
  switch (asked.what) {
  case api_act::command:
    return command(asked, who.who);
  case api_act::view_control:
    return view_control(asked, who.who);
  case api_act::change_control:
    return change_control(asked, who.who);
  case api_act::read_audit:
    return read_audit(asked, who.who);
  case api_act::list_points:
    return list_points(asked);
  case api_act::decide_point:
    return decide_point(asked, who.who);
  case api_act::override_rule:
    return override_rule(asked, who.who);
  case api_act::look:
    return answers_->let_go_on(asked.ticket);
  case api_act::log_out:
    return log_out(asked, who.who);
  default:
    return answers_->resolve(asked.ticket, answer_of(who.who, who.ends_ns, wall_ns(), 200));
  }
}

void operator_handler::command(const api_request& asked, const principal& who) {
  auto said = asked.said;
  said.by = who;
  ask_bridge(asked, command_timeout, std::move(said), [this, asked](const operator_bridge::command_answer& answer) {
    answers_->resolve(asked.ticket, answer_of(asked.said.id, answer));
  });
}

void operator_handler::view_control(const api_request& asked, const principal& who) {
  ask_bridge(asked, answer_timeout, operator_bridge::get_operators{},
             [this, asked, who](const operator_bridge::operators_view& view) {
               answers_->resolve(asked.ticket, answer_of(view, who));
             });
}

void operator_handler::change_control(const api_request& asked, const principal& who) {
  ask_bridge(asked, answer_timeout, operator_bridge::change_control{who, asked.act, asked.to},
             [this, asked](const operator_bridge::control_answer& answer) {
               answers_->resolve(asked.ticket, answer_of(answer));
             });
}

void operator_handler::read_audit(const api_request& asked, const principal& who) {
  ask_bridge(asked, answer_timeout, operator_bridge::read_audit{who},
             [this, asked](const operator_bridge::audit_leave& answer) {
               if (!answer.refusal.empty())
                 return answers_->resolve(asked.ticket, problem(403, answer.refusal));
               others_.read_audit({asked.before, asked.rows},
                                  [answers = answers_, ticket = asked.ticket](const auto& page) {
                                    answers->resolve(ticket, page ? answer_of(*page) : problem(503, page.error()));
                                  });
             });
}

// While no mission with scanning flies there is nobody to ask, and nothing to decide.
void operator_handler::list_points(const api_request& asked) {
  ask(
      others_.points, answer_timeout, scan_controller::get_points{},
      [this, asked](const scan_controller::points& seen) {
        const auto pictured = others_.pictured ? others_.pictured() : std::vector<std::uint64_t>();
        answers_->resolve(asked.ticket, answer_of(telemetry_stream::update_of(seen, pictured, wall_ns())));
      },
      [this, asked](const runtime::ask_error& why) {
        answers_->resolve(asked.ticket, why.code == runtime::ask_errc::not_taken
                                            ? answer_of(telemetry_stream::points_update{})
                                            : problem(504, "scan_controller does not answer: " + why.what));
      });
}

// Of what operator_bridge has not written itself.
void operator_handler::answer_and_note(const api_request& asked, const principal& who, const std::string& what,
                                       const operator_bridge::command_answer& answer) {
  tell(others_.bridge, operator_bridge::audit_note{who, what, std::string(io::name_of(answer.verdict)), answer.reason});
  answers_->resolve(asked.ticket, answer_of(asked.said.id, answer));
}

// What is no command has its rules. ACT ends with the answer, which is a row of the audit.
void operator_handler::with_leave(const api_request& asked, const principal& who, const std::string& what,
                                  std::function<void(const end_act& end)> act) {
  const auto end = [this, asked, who, what](const operator_bridge::command_answer& answer) {
    answer_and_note(asked, who, what, answer);
  };
  ask_bridge(asked, answer_timeout, operator_bridge::ask_leave{who, what},
             [this, asked, end, act = std::move(act)](const operator_bridge::leave& answer) {
               if (answer.verdict == verdict::taken)
                 act(end);
               else
                 answers_->resolve(asked.ticket, answer_of({}, {answer.verdict, answer.reason}));
             });
}

void operator_handler::decide_point(const api_request& asked, const principal& who) {
  auto decided = asked.decided;
  decided.by = who.name;
  const auto what = std::string(io::name_of(decided.says)) + " point " + std::to_string(decided.number);
  with_leave(asked, who, what, [this, decided](const end_act& end) {
    ask(
        others_.points, answer_timeout, decided,
        [end](const scan_controller::decide_answer& answer) {
          end({answer.is_taken ? verdict::taken : verdict::refused, answer.reason});
        },
        [end](const runtime::ask_error& why) {
          if (why.code == runtime::ask_errc::not_taken)
            end({verdict::not_done, "points of interest are not scanned for now: no mission with scanning is flown"});
          else
            end({verdict::unknown, "there is no answer; check the points before you send it again"});
        });
  });
}

// As at the control socket it needs an engineer, and here, where several operators are, control too. The reason is
// part of what is in the audit.
void operator_handler::override_rule(const api_request& asked, const principal& who) {
  const auto what = "override " + std::string(io::name_of(asked.overridden.scope)) + " for " +
                    std::to_string(asked.lasts_s) + " s: " + asked.overridden.reason;
  if (who.role < operators::role::engineer)
    return answer_and_note(asked, who, what, {verdict::wrong_role, "an engineer overrides a rule of the failsafe"});
  with_leave(asked, who, what, [this, wanted = asked.overridden, lasts_s = asked.lasts_s](const end_act& end) mutable {
    wanted.until_ns = wall_ns() + std::int64_t{lasts_s} * 1'000'000'000;
    ask(
        others_.failsafe, answer_timeout, wanted,
        [end](const failsafe::override_answer& answer) {
          end({answer.taken ? verdict::taken : verdict::refused, answer.reason});
        },
        [end](const runtime::ask_error&) {
          end({verdict::unknown, "the failsafe does not answer; check the status before you send it again"});
        });
  });
}

void operator_handler::log_out(const api_request& asked, const principal& who) {
  ask_bridge(asked, answer_timeout, operator_bridge::end_session{who},
             [this, asked](const operator_bridge::session_ended&) {
               identified_.erase(asked.token_hash);
               answers_->resolve(asked.ticket, {204, {}, {}, {}}, waiting_answers::cookie::ends_session);
             });
}

void operator_handler::opened(const api_request& asked, const operator_bridge::session_answer& answer) {
  if (answer.is_open)
    answers_->resolve(asked.ticket, answer_of(answer.who, answer.ends_ns, wall_ns(), 201),
                      waiting_answers::cookie::opens_session);
  else
    answers_->resolve(asked.ticket, problem(401, answer.reason));
}

void operator_handler::note_stranger(const api_request& asked, const std::string& what, const std::string& outcome) {
  tell(others_.bridge,
       operator_bridge::audit_note{{asked.account.name, operators::role::viewer, {}}, what, outcome, {}});
}

} // namespace godwit::operator_port
