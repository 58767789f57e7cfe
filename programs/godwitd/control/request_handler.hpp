// The control request_handler: asks the actors what somebody at the control socket wants to know or to have done, and
// answers when all of them have, or have not.
//
// The socket's thread can tell actors but not ask them; this actor can. An actor that does not answer in time is in the
// answer as an error; whoever waits gets one in any case, but for a crash of the request_handler: then the socket's own
// time-out says so. Whoever reaches the socket is an engineer, under the name that is given.
//
// Commands go through operator_bridge. When that does not answer, a hold or a return goes to the executor all the same:
// it may then be said twice, which does no harm. Errors: in the answers. Thread: as actor_base.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "messages/executor/handle.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/fleet_link/handle.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/health/handle.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/movement_detector/handle.hpp"
#include "messages/operator_bridge/handle.hpp"
#include "messages/scan_controller/handle.hpp"
#include "messages/vehicle_link/handle.hpp"
#include "programs/godwitd/audit_reader.hpp"
#include "programs/godwitd/control/messages.hpp"
#include "programs/godwitd/control/port_view.hpp"
#include "programs/godwitd/control/response_queue.hpp"
#include "programs/godwitd/ground_run/messages.hpp"
#include "programs/godwitd/sightings/messages.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/supervision/handle.hpp"

namespace godwit::control {

using vehicle_handle = runtime::mailbox<runtime::asks<vehicle_link::get_connection, vehicle_link::connection>,
                                        runtime::asks<vehicle_link::set_up_signing, vehicle_link::signing_answer>>;
using request_handle = runtime::mailbox<runtime::tells<control_request>>;

using ground_handle = runtime::mailbox<runtime::asks<ground_port::get_port, ground_port::port_description>>;
using failsafe_status_handle =
    runtime::mailbox<runtime::asks<failsafe::get_failsafe_status, failsafe::failsafe_status>>;
using override_handle = runtime::mailbox<runtime::asks<failsafe::override_rule, failsafe::override_answer>>;

struct peers {
  mission_client::operator_handle client; // none without a service
  mapobjects_store::operator_handle store;
  vehicle_handle vehicle;
  std::optional<ground_run::status_handle> run;           // of a run on the ground
  std::optional<executor::operator_handle> flight;        // else
  std::optional<executor::missions_handle> missions;      // with a flight
  std::optional<executor::view_handle> traffic;           // the same
  std::optional<operator_bridge::handler_handle> bridge;  // with a flight
  std::optional<ground_handle> ground;                    // with a flight and a line for ground stations
  std::optional<override_handle> failsafe;                // with a flight
  std::optional<failsafe_status_handle> failsafe_status;  // with a flight
  std::optional<scan_controller::operator_handle> points; // with a flight
  std::optional<health::status_handle> health;
  std::optional<sightings::status_handle> sightings;    // with a flight
  std::optional<movement_detector::status_handle> eyes; // with a camera
  std::optional<fleet_link::status_handle> fleet;       // with a broker
  std::shared_ptr<const port_view> port;                // null: nobody shows it
  runtime::guardian_handle guardian;
  std::function<bool(const std::string& name)> crash; // empty: not allowed. False: no such actor
  using rescued = std::function<void(tl::expected<std::string, std::string>)>; // the new file, or why not
  std::function<void(rescued then)> rescue_journal;                            // THEN: in any thread
  audit_source read_audit;                                                     // with a flight
};

class request_handler final : public runtime::actor_base<request_handle> {
public:
  static constexpr std::chrono::seconds answer_timeout{3};  // below that of the socket
  static constexpr std::chrono::seconds command_timeout{4}; // the same; longer than operator_bridge takes

  request_handler(runtime::spawn_context context, peers others, std::shared_ptr<response_queue> answers);
  ~request_handler() override;

protected:
  behavior_type handlers() override;

private:
  struct half_answer {
    nlohmann::json document;
    int missing = 0;
  };

  void take(const control_request& asked);
  void collect_status(std::uint64_t ticket);
  void retry(const control_request& asked);
  void say(const control_request& asked);
  void say_directly(const control_request& asked);
  template <class Answer, class Question, class Writer>
  void ask_bridge(const control_request& asked, const Question& question, Writer json_of);
  void change_control(const control_request& asked);
  void list_audit(const control_request& asked);
  void make_link(const control_request& asked);
  void note(const control_request& asked, const std::string& what, bool is_done, const std::string& reason);
  void list_points(std::uint64_t ticket);
  void decide_point(const control_request& asked);
  void pass_decision_on(const control_request& asked);
  void insert_at_point(const control_request& asked);
  template <class Then>
  void ask_points(std::uint64_t ticket, Then then);
  void override_rule(const control_request& asked);
  void sign(const control_request& asked);
  void crash(const control_request& asked);
  void rescue_journal(const control_request& asked);
  template <class Answer, class Handle, class Question, class Reader>
  void pass_on(const control_request& asked, const std::string& what, const Handle& who, const Question& question,
               Reader taken_and_why);
  template <class Handle, class Question>
  void collect(std::uint64_t ticket, const char* part, const Handle& who, Question question);
  template <class Handle, class Question>
  void collect_wanted(std::uint64_t ticket, const char* part, const Handle& who, Question question,
                      const char* resting);
  void put(std::uint64_t ticket, const char* part, nlohmann::json what);
  void answer_with(std::uint64_t ticket, const nlohmann::json& document);

  peers others_;
  std::shared_ptr<response_queue> answers_;
  std::map<std::uint64_t, half_answer> collecting_; // by ticket: at most one for each client of the socket
};

} // namespace godwit::control
