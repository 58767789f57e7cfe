#include "actors/failsafe/actor.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "actors/failsafe/first_look.hpp"
#include "actors/failsafe/vehicle_texts.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "runtime/assert.hpp"

namespace godwit::failsafe {

using vehicle_link::command_outcome;
using vehicle_link::command_verdict;
using vehicle_link::connection_changed;

namespace {

namespace mavlink = io::mavlink;

command_verdict verdict_of(runtime::ask_errc why) {
  return why == runtime::ask_errc::not_taken ? command_verdict::not_sent : command_verdict::timed_out;
}

} // namespace

// -- what is heard --------------------------------------------------------------------------------

template <class M>
auto actor::hears() {
  return on<M>([this](const M& message) {
    look_.heard(M::message_id);
    if constexpr (std::is_same_v<M, mavlink::heartbeat>)
      take_heartbeat(message);
    if constexpr (std::is_same_v<M, mavlink::current_mode>)
      take_current_mode(message);
    core_->take(sense(message), now());
    if constexpr (std::is_same_v<M, mavlink::global_position_int>)
      judge_position();
  });
}

// What others say is decided on, and handed to the journal, in the turn in which it came: it would not come again.
template <class M>
auto actor::is_told() {
  return on<M>([this](const M& what) {
    core_->take(what, now());
    turn();
  });
}

actor::actor(runtime::spawn_context context, const settings& configured, vehicle_handle vehicle,
             std::shared_ptr<const peers> others)
    : durable_actor(std::move(context)), settings_(configured), vehicle_(std::move(vehicle)),
      others_(std::move(others)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {on_deferred<guard_mission, guard_answer>([this](const guard_mission& what, std::uint64_t request_id) {
            core_->take(asked_guard{request_id, what}, now());
            turn();
          }),
          is_told<expect_mode>(),
          is_told<taken_over>(),
          is_told<command_pending>(),
          is_told<following>(),
          is_told<return_taken>(),
          is_told<hand_back>(),
          on_deferred<override_rule, override_answer>([this](const override_rule& what, std::uint64_t request_id) {
            core_->take(asked_override{request_id, what}, now());
            turn();
          }),
          on<get_failsafe_status>([this](const get_failsafe_status&) { return core_->told(); }),
          hears<mavlink::heartbeat>(),
          hears<mavlink::current_mode>(),
          hears<mavlink::extended_sys_state>(),
          hears<mavlink::global_position_int>(),
          hears<mavlink::home_position>(),
          hears<mavlink::sys_status>(),
          hears<mavlink::mission_current>(),
          hears<mavlink::statustext>(),
          on<connection_changed>([this](const connection_changed& m) {
            if (m.phase == vehicle_link::connection_phase::connected)
              look_.begin();
          }),
          is_told<vehicle_link::foreign_act>(),
          on<ground_port::operator_link>([this](const ground_port::operator_link& m) {
            core_->take(operator_heard{m.ever_heard, m.age_ms}, now());
          }),
          on<operator_bridge::holder_heard>(
              [this](const operator_bridge::holder_heard&) { core_->take(controller_heard{}, now()); }),
          on<tick>([this](const tick& which) {
            if (which.number == tick_number_)
              on_tick();
          })};
}

void actor::started() {
  core_.emplace(settings_, current_state(), now());
  look_.begin();
  post_health();
  tell_failsafe_status(); // also to those who were told before the crash, or have crashed as well
  plan_tick(std::chrono::milliseconds::zero());
}

void actor::on_tick() {
  plan_tick(std::chrono::milliseconds(tick_ms));
  look_further(true);
  turn();
}

void actor::plan_tick(std::chrono::milliseconds delay) { tell_after(delay, me(), tick{++tick_number_}); }

void actor::judge_position() {
  if (position_judged_ns_ && now().monotonic_ns - *position_judged_ns_ < min_judged_gap_ms * ns_per_ms)
    return;
  position_judged_ns_ = now().monotonic_ns;
  turn();
}

// -- what is done ---------------------------------------------------------------------------------

void actor::turn() { execute(core_->tick(now())); }

void actor::execute(const effects& wanted) {
  due_ = {};
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { execute(what); }, each);
  GODWIT_ASSERT(!due_.command || due_.record, "failsafe: each command comes with a record");
  if (due_.command)
    send_at_once([this] { command(*due_.command); });
  else if (due_.failsafe_status_is_new)
    tell_failsafe_status();
  if (due_.record)
    commit(*due_.record);
  if (due_.command)
    write_now(); // a crash from here on must not forget it
  post_health();
}

void actor::execute(const warning& what) {
  for (const auto& each : others_->people)
    tell(each, ground_port::status_text{what.severity, what.text});
  others_->log(what);
}

// What the executor sends after the answer explains itself to the next process: the limits are on the disk, and the
// modes that were announced before.
void actor::execute(const guard_resolved& what) {
  after_commit([this, what] { answer_later(what.request_id, what.answer); });
}

void actor::execute(const remember& what) { due_.record = what.what; }

void actor::tell_failsafe_status() {
  for (const auto& ear : others_->ears)
    tell(ear, core_->told());
}

void actor::take_heartbeat(const mavlink::heartbeat& m) {
  owner_ = flight::owner_of(m);
  seen_ = {m.custom_mode, io::mavlink::is_armed(m)};
}

void actor::take_current_mode(const mavlink::current_mode& m) {
  if (seen_)
    seen_->custom_mode = m.custom_mode;
}

// What vehicle_link holds against it, and by what it keeps back orders that were decided without knowing of it.
std::optional<vehicle_link::seen_state> actor::known_with(std::uint64_t command_number) const {
  auto result = seen_;
  if (result)
    result->failsafe_command = command_number;
  return result;
}

void actor::command(const command_vehicle& command) {
  auto words = words_for(command, owner_);
  GODWIT_ASSERT(words, "failsafe: of a vehicle only that is wanted which its kind can do");
  words->only_while = known_with(command.number);
  tell_failsafe_status();
  ask(
      vehicle_, answer_patience, *words,
      [this, command](const command_outcome& outcome) { resolve(command, outcome.verdict); },
      [this, command](const runtime::ask_error& why) { resolve(command, verdict_of(why.code)); });
}

// Another's change of mode is under way, and the failsafe's does not wait for that. Whether SET_MODE was obeyed is what
// a later heartbeat says, as after a command without an answer.
void actor::resolve(const command_vehicle& command, command_verdict verdict) {
  if (verdict == command_verdict::already_running)
    if (auto words = mode_words_for(command, owner_)) {
      words->only_while = known_with(command.number);
      tell(vehicle_, *words);
      verdict = command_verdict::timed_out;
    }
  core_->take(command_resolved{command.number, verdict}, now());
}

// -- the first look at the vehicle ------------------------------------------------------------------

void actor::look_further(bool at_tick) {
  const auto wanted = look_.next(at_tick);
  if (!wanted)
    return;
  vehicle_link::send_command request;
  request.command = mavlink::number(mavlink::mav_cmd::request_message);
  request.param1 = static_cast<float>(*wanted);
  ask(
      vehicle_, answer_patience, request,
      [this](const command_outcome& outcome) { end_look(outcome.verdict == command_verdict::accepted); },
      [this](const runtime::ask_error&) { end_look(false); });
}

// The next one at once; what was not answered again at a tick.
void actor::end_look(bool is_answered) {
  look_.resolved();
  if (is_answered)
    look_further(false);
}

// -- health ---------------------------------------------------------------------------------------

void actor::post_health() {
  auto how = core_->health();
  if (is_refused_by_journal())
    how = {runtime::health_colour::red,
           "what the failsafe does can not be written down" + (how.reason.empty() ? std::string() : "; " + how.reason)};
  show_health(std::move(how));
}

} // namespace godwit::failsafe
