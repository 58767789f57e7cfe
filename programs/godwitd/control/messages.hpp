// What the control socket asks of the request_handler. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/operator/types.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/scan_controller/point.hpp"

namespace godwit::control {

enum class request_kind {
  status,
  outbox_retry,
  command,        // of an operator
  override_rule,  // of the failsafe
  crash,          // an actor, for drills
  rescue_journal, // its file is lost
  points,         // of interest
  decide_point,
  control, // who has it
  audit,   // what operators have said
  login,   // a link that logs in once
  sign     // the signing key goes to the vehicle
};

constexpr auto enum_names(request_kind) {
  return io::names<request_kind>({{request_kind::status, "status"},
                                  {request_kind::outbox_retry, "outbox_retry"},
                                  {request_kind::command, "word"},
                                  {request_kind::override_rule, "override_rule"},
                                  {request_kind::crash, "crash"},
                                  {request_kind::rescue_journal, "rescue_journal"},
                                  {request_kind::points, "points"},
                                  {request_kind::decide_point, "decide_point"},
                                  {request_kind::control, "control"},
                                  {request_kind::audit, "audit"},
                                  {request_kind::login, "login"},
                                  {request_kind::sign, "sign"}});
}

struct control_request {
  std::uint64_t ticket = 0; // whom the answer is for
  request_kind what = request_kind::status;
  std::string key;         // outbox_retry: of one row; empty: all. crash: the name of the actor. login: the link's hash
  operators::command said; // word
  failsafe::override_rule overridden;                                    // override_rule; without its end
  std::int64_t lasts_s = 0;                                              // override_rule
  std::string by = {};                                                   // who asks
  std::string id = {};                                                   // word; empty: it is not repeated
  std::int64_t valid_until_ns = 0;                                       // word; ns since 1970 (UTC), 0: a few seconds
  operator_bridge::control_act act = operator_bridge::control_act::take; // control
  std::string to = {};                                                   // control: hand_over
  std::uint32_t rows = 50;                                               // audit: the newest
  std::uint64_t before = 0;                                              // audit: of those before this number
  scan_controller::decide_point decided = {};                            // decide_point
  std::uint64_t point = 0;   // insert: at the place of this one, which a person has confirmed; 0: none
  bool ends_signing = false; // sign: the vehicle has no key from then on
  GODWIT_FIELDS(control_request, "control.request", ticket, what, key, said, overridden, lasts_s, by, id,
                valid_until_ns, act, to, rows, decided, point, ends_signing);
};

} // namespace godwit::control
