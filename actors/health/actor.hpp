// The health of the program as an actor: looks at the board each second, tells listeners what has changed, and asks all
// others how they are when somebody wants a report.
//
//   board ──each second──> core ──> listeners, report_port
//   make_report ──> asks all peers ──answers, or no answer in time──> report ──> report_port
//
// One report is made at a time: who asks meanwhile gets the one that is under way. Nothing is durable, nobody depends
// on it, and it commands nothing. Errors: a peer that does not answer is named in the report. Thread: as actor_base.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "actors/health/core.hpp"
#include "actors/health/report_port.hpp"
#include "messages/executor/handle.hpp"
#include "messages/health/handle.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/supervision/handle.hpp"

namespace godwit::health {

// Filled in while the process is composed, before the actors start. What is empty is not asked.
struct peers {
  runtime::guardian_handle guardian;
  runtime::mailbox<runtime::asks<executor::get_flight, executor::flight_status>> flight;
  runtime::mailbox<runtime::asks<executor::get_missions, executor::known_missions>> missions;
  runtime::mailbox<runtime::asks<executor::get_traffic, executor::heard_traffic>> traffic;
  runtime::mailbox<runtime::asks<failsafe::get_failsafe_status, failsafe::failsafe_status>> failsafe;
  runtime::mailbox<runtime::asks<vehicle_link::get_connection, vehicle_link::connection>> vehicle;
  runtime::mailbox<runtime::asks<ground_port::get_port, ground_port::port_description>> ground;
  runtime::mailbox<runtime::asks<mission_client::get_service, mission_client::service_status>> service;
  runtime::mailbox<runtime::asks<mapobjects_store::get_map, mapobjects_store::map_status>> map;
  runtime::mailbox<runtime::asks<fleet_link::get_fleet, fleet_link::fleet_view>> fleet;
  std::vector<listener_handle> listeners;
};

// The world outside of the actors. May be called by any thread and does not block.
struct outside_world {
  std::function<host_figures()> read_host;
};

// All entries of the board, recorded where they have changed.
struct board_view {
  std::vector<posted> all;
  GODWIT_FIELDS(board_view, "health.board_view", all);
};

class actor final : public runtime::actor_base<own_handle> {
public:
  static constexpr std::chrono::seconds look_period{1};
  static constexpr std::chrono::seconds answer_timeout{2}; // below that of who waits for the report

  actor(runtime::spawn_context context, std::shared_ptr<const peers> others, outside_world world,
        std::shared_ptr<report_port> port);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override { on_deadline(); }
  void on_deadline() override;

private:
  void look_at_board();
  void collect();
  template <class Handle, class Question, class Answer>
  void collect_part(const char* part, const Handle& who, Question question, std::optional<Answer> report::*where);
  void collect_actors();
  void take_part();

  std::shared_ptr<const peers> others_;
  outside_world world_;
  std::shared_ptr<report_port> port_;
  core core_;
  std::optional<board_view> seen_; // as recorded last
  report half_;                    // under way
  int missing_ = 0;                // answers that it waits for; 0: none is under way
};

} // namespace godwit::health
