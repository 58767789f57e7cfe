// The part of the port that operators act through:
//
//   POST   /api/v1/session    log in: {"name", "password"} or {"link"}      GET: who am I   DELETE: log out
//   POST   /api/v1/commands   a command (request_body.hpp)
//   GET    /api/v1/control    who has it                                    POST: {"act", "to"}
//   GET    /api/v1/audit      ?rows=50&before=1200
//   GET    /api/v1/points     of interest                                   POST: {"point", "decision"}
//
// A program sends its token as "Authorization: Bearer ...", a browser has a cookie. Bodies are application/json, which
// a page of another site can not send unasked. Errors: problem documents. Thread: that of the port.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "programs/godwitd/accounts/account_keeper.hpp"
#include "programs/godwitd/operator_port/operator_handler.hpp"
#include "programs/godwitd/operator_port/request_body.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "programs/godwitd/operator_port/waiting_answers.hpp"

namespace godwit::operator_port {

class operator_api {
public:
  // To the handler; may be called by any thread, one at a time.
  using inlet = std::function<void(api_request asked)>;

  operator_api(std::shared_ptr<waiting_answers> answers, accounts::account_keeper& keeper, inlet tell);

  void log_in(io::http::server_request asked, io::http::responder answer);
  void command(const io::http::server_request& asked, io::http::responder answer);
  void change_control(const io::http::server_request& asked, io::http::responder answer);
  void decide_point(const io::http::server_request& asked, io::http::responder answer);
  void override_rule(const io::http::server_request& asked, io::http::responder answer);
  void read_audit(const io::http::server_request& asked, io::http::responder answer);
  // For the audit: a page of another site has asked, and was refused.
  void note_other_origin(const std::string& from);
  // THEN, in any thread, when who asks has a session or a token.
  void admit(const io::http::server_request& asked, io::http::responder answer,
             std::function<void(io::http::responder)> then);
  // What needs nothing but a token: who_am_i, log_out, view_control, list_points.
  void ask(api_act what, const io::http::server_request& asked, io::http::responder answer);

private:
  void tell(api_request asked, const io::http::server_request& from, io::http::responder answer);
  void check_password(login_body said, const std::string& from, io::http::responder answer);
  void use_link(login_body said, const std::string& from, io::http::responder answer);

  std::shared_ptr<waiting_answers> answers_;
  accounts::account_keeper& keeper_;
  inlet tell_;
};

// Where the operator's API lies on the port. Thread: that of the port.
[[nodiscard]] route_list routes_of(const std::shared_ptr<operator_api>& api);

} // namespace godwit::operator_port
