// Takes the mission that an operator hands over, for a godwitd that has no service to bring it one.
//
//   upload ──> who? operator? control? on the ground? ──> executor: mission_loaded ──> row of the audit ──> answer
//
// The mission gets an id of its own, so that it is never a revision of the one that is flown: it is taken on the
// ground, checked as any other, and starts by nobody's word but an operator's. Errors: problem documents. Thread: as
// actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/executor/handle.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/operator_bridge/handle.hpp"
#include "programs/godwitd/operator_port/waiting_answers.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::operator_port {

struct mission_upload {
  std::uint64_t ticket = 0;
  std::string token_hash; // of who comes; empty: without a token
  mission::document mission;
  GODWIT_FIELDS(mission_upload, "operator_port.mission_upload", ticket, token_hash, mission);
};

using mission_inlet = runtime::mailbox<runtime::tells<mission_upload>>;

struct mission_peers {
  runtime::combine<operator_bridge::handler_handle, operator_bridge::door_handle> bridge;
  executor::operator_handle flight;
  runtime::mailbox<runtime::tells<mission_client::mission_loaded>> missions;
};

class mission_handler final : public runtime::actor_base<mission_inlet> {
public:
  static constexpr std::chrono::seconds answer_timeout{1}; // of each of three questions

  // WHY_NOT: a sentence, where missions come another way; empty: they are taken.
  mission_handler(runtime::spawn_context context, mission_peers others, std::shared_ptr<waiting_answers> answers,
                  std::string why_not);
  ~mission_handler() override;

protected:
  behavior_type handlers() override;

private:
  using upload_ptr = std::shared_ptr<const mission_upload>;

  void take(const upload_ptr& asked);
  void look_at_control(const upload_ptr& asked, const operators::principal& who);
  void look_at_flight(const upload_ptr& asked, const operators::principal& who);
  void hand_over(const upload_ptr& asked, const operators::principal& who);
  void refuse(const mission_upload& asked, const operators::principal& who, operator_bridge::verdict why,
              const std::string& sentence);
  template <class Handle, class Question, class OnAnswer>
  void ask_about(const mission_upload& asked, const Handle& whom, Question question, OnAnswer on_answer);

  mission_peers others_;
  std::shared_ptr<waiting_answers> answers_;
  std::string why_not_;
};

} // namespace godwit::operator_port
