// Asks operator_bridge what a client of the operator's port wants, and answers it.
//
//   request ──who comes with this token?──> identity ──> command, control, audit, points, override, log out ──> answer
//            └─ a password that was right, a link ──> session_answer ──> answer with a cookie
//
// Who is not known is answered 401, and stands in the audit as a stranger. Where operator_bridge does not answer, a
// hold or a return of an operator whom it has identified before goes to the executor itself. Errors: as answers with a
// problem document. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/operator/types.hpp"
#include "messages/operator_bridge/handle.hpp"
#include "messages/scan_controller/handle.hpp"
#include "programs/godwitd/audit_reader.hpp"
#include "programs/godwitd/operator_port/waiting_answers.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::operator_port {

enum class api_act {
  who_am_i,
  command,
  view_control,
  change_control,
  read_audit,
  list_points,
  decide_point,
  override_rule, // of the failsafe
  log_out,
  look,         // may this client look at all?
  open_session, // the password was right
  use_link,
  refuse_login, // it was not
  refuse_origin // a page of another site has asked
};

GODWIT_ENUM_NAMES(api_act, who_am_i, command, view_control, change_control, read_audit, list_points, decide_point,
                  override_rule, log_out, look, open_session, use_link, refuse_login, refuse_origin);

struct api_request {
  std::uint64_t ticket = 0; // 0: nobody waits for an answer
  api_act what = api_act::who_am_i;
  std::string token_hash;                                                // of who comes; empty: without a token
  std::string from;                                                      // for people: an address
  operator_bridge::operator_command said;                                // command; without the principal
  operator_bridge::control_act act = operator_bridge::control_act::take; // change_control
  std::string to;                                                        // the same: hand_over
  std::uint32_t rows = 50;                                               // read_audit
  std::uint64_t before = 0;                                              // the same: of those before this number
  scan_controller::decide_point decided;                                 // decide_point; without who does
  failsafe::override_rule overridden;                                    // override_rule; without its end
  std::uint32_t lasts_s = 0;                                             // override_rule
  operator_bridge::account account;                                      // open_session; its name: refuse_login
  std::string new_token_hash;                                            // open_session, use_link
  std::string link_hash;                                                 // use_link
  GODWIT_FIELDS(api_request, "operator_port.request", ticket, what, token_hash, from, said, act, to, rows, before,
                decided, overridden, lasts_s, account, new_token_hash, link_hash);
};

using request_inlet = runtime::mailbox<runtime::tells<api_request>>;
using bridge_handle = runtime::combine<operator_bridge::handler_handle, operator_bridge::door_handle>;
using override_handle = runtime::mailbox<runtime::asks<failsafe::override_rule, failsafe::override_answer>>;

using stop_handle = runtime::mailbox<runtime::asks<operators::command, operators::answer>>;

// Whom it asks.
struct handler_peers {
  bridge_handle bridge;
  stop_handle flight; // for holds and returns alone
  scan_controller::operator_handle points;
  override_handle failsafe;
  // Numbers of points that the camera has shown; empty: there is no camera. Does not block.
  std::function<std::vector<std::uint64_t>()> pictured = {};
  audit_source read_audit = {};
};

class operator_handler final : public runtime::actor_base<request_inlet> {
public:
  static constexpr std::chrono::seconds answer_timeout{2};
  static constexpr std::chrono::seconds command_timeout{4}; // longer than operator_bridge takes
  static constexpr std::size_t max_identified = 64;         // as many sessions as operator_bridge keeps, and programs

  operator_handler(runtime::spawn_context context, handler_peers others, std::shared_ptr<waiting_answers> answers);
  ~operator_handler() override;

protected:
  behavior_type handlers() override;

private:
  void take(const api_request& asked);
  void identify(const api_request& asked);
  void take_known(const api_request& asked, const operator_bridge::identity& who);
  void command(const api_request& asked, const operators::principal& who);
  [[nodiscard]] bool may_stop(const api_request& asked);
  void stop_directly(const api_request& asked);
  void remember(const std::string& token_hash, const operator_bridge::identity& who);
  void view_control(const api_request& asked, const operators::principal& who);
  void change_control(const api_request& asked, const operators::principal& who);
  void read_audit(const api_request& asked, const operators::principal& who);
  void list_points(const api_request& asked);
  void decide_point(const api_request& asked, const operators::principal& who);
  void override_rule(const api_request& asked, const operators::principal& who);
  void answer_and_note(const api_request& asked, const operators::principal& who, const std::string& what,
                       const operator_bridge::command_answer& answer);
  using end_act = std::function<void(const operator_bridge::command_answer& answer)>;
  void with_leave(const api_request& asked, const operators::principal& who, const std::string& what,
                  std::function<void(const end_act& end)> act);
  void log_out(const api_request& asked, const operators::principal& who);
  void opened(const api_request& asked, const operator_bridge::session_answer& answer);
  void note_stranger(const api_request& asked, const std::string& what, const std::string& outcome);
  template <class Question, class OnAnswer>
  void ask_bridge(const api_request& asked, std::chrono::milliseconds patience, Question question, OnAnswer on_answer);

  handler_peers others_;
  std::map<std::string, operator_bridge::identity> identified_; // by the hash of the token; sessions that may be open
  std::shared_ptr<waiting_answers> answers_;
};

} // namespace godwit::operator_port
