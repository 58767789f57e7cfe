#include "actors/executor/core.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/remaining.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::executor {
namespace {

namespace transfer = vehicle_link::transfer;
using flight::mode_kind;
using mission_client::pull_state;

// Downloads that settle an upload have numbers of their own, above all those of the runner.
constexpr std::uint64_t first_reading_back = 1ULL << 32U;
constexpr std::int64_t read_again_after_ns = 2'000'000'000;
constexpr std::int64_t check_period_ns = 1'000'000'000;
constexpr std::int64_t plan_end_expected_ns = 10'000'000'000; // told again in good time while the plan ends
constexpr std::int64_t last_word_within_ns = 4'000'000'000;   // MISSION_CURRENT comes once a second, and may be lost

bool is_before_start(phase now) {
  return now == phase::disconnected || now == phase::connected || now == phase::preflight || now == phase::uploading ||
         now == phase::ready;
}

// A plan may leave the vehicle in these.
bool ends_plans(mode_kind kind) {
  return kind == mode_kind::hold || kind == mode_kind::returning || kind == mode_kind::landing;
}

bool is_over(phase now) { return now == phase::post_flight || is_at_rest(now); }

} // namespace

effects core::on_start(instant now) {
  began_ns_ = now.now_ns;
  last_task_before_ = s_.last_task;
  if (const auto& plan = s_.progress.plan) // what was to be done about it died with the incarnation that was told
    must_choose_item_ = plan->generation.is_not_at_start_told && !plan->generation.is_armed;
  effects out;
  const bool is_fresh = !s_.doing && !is_in_flight() && !s_.progress.upload && !s_.progress.start;
  has_looked_ = is_fresh && (s_.standing.now == phase::disconnected || s_.standing.now == phase::connected ||
                             is_over(s_.standing.now));
  if (settings_.has_service && !settings_.mission_id.empty())
    out.emplace_back(say_to_client{mission_client::begin_mission{settings_.mission_id}});
  if (settings_.has_service && s_.standing.now == phase::post_flight && s_.mission)
    out.emplace_back(say_to_client{mission_client::push_map{s_.mission->mission_id}});
  if (s_.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::restarted{}});
  return out;
}

std::int64_t core::next_deadline_ns(instant now) const {
  return std::min(runner_.next_deadline_ns(), now.now_ns + check_period_ns / 2);
}

// What follows from a note is decided when it is applied.
effects core::advance(instant now) {
  effects out;
  for (bool goes_on = true; goes_on;) {
    const auto before = out.size();
    static_cast<void>(recover(out, now) || settle(out, now) || heed_others(out, now) || run_task(out, now) ||
                      end_flight(out, now) || answer_assignment(out, now) || deploy_arrived(out, now) ||
                      follow_started(out) || begin_wished(out, now) || prepare(out, now));
    const bool has_notes =
        std::any_of(out.begin(), out.end(), [](const effect& each) { return std::holds_alternative<note>(each); });
    goes_on = out.size() != before && !has_notes;
  }
  return out;
}

// -- the vehicle ------------------------------------------------------------------------------------

effects core::on_vehicle(const vehicle_link::connection_changed& m, instant) {
  view_.take(m);
  return {};
}

effects core::on_vehicle(const vehicle_link::vehicle_restarted&, instant) {
  effects out;
  if (progress::matters(s_.progress, progress::vehicle_rebooted{}, 0))
    out.emplace_back(note{progress::vehicle_rebooted{}});
  return out;
}

effects core::on_vehicle(const io::mavlink::heartbeat& m, instant now) {
  view_.take(m, now.now_ns);
  if (view_.is_under_way())
    was_up_ = true;
  if (!has_looked_ || !is_in_flight() || !view_.is_armed())
    return {};
  effects out;
  const bool leads_down =
      is_at_plan_end() || s_.standing.now == phase::landing || s_.progress.paused == progress::pause_reason::aborted;
  modes_.set_plan_end(leads_down);
  if (leads_down)
    plan_ends(out, now);
  if (stance_ && stance_->reacts)
    modes_.adopt(*view_.mode());
  else if (!modes_.is_taken_over_by(*view_.mode(), now.now_ns))
    unclear_since_ns_ = 0;
  else if (unclear_since_ns_ == 0)
    unclear_since_ns_ = now.now_ns;
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_current& m, instant now) {
  view_.take(m, now.now_ns);
  effects out;
  const progress::current_told told{m, !view_.is_armed()};
  if (s_.progress.plan && progress::matters(s_.progress, told, now.wall_ns))
    out.emplace_back(note{told});
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_item_reached& m, instant now) {
  effects out;
  const progress::reached_told told{m.seq};
  if (s_.progress.plan && progress::matters(s_.progress, told, now.wall_ns))
    out.emplace_back(note{told});
  return out;
}

core::release core::lets_out(const order& what, instant now) {
  const bool is_meant = what.number >= first_reading_back ? what.number == reading_back_ : runner_.lets_out(what);
  if (!is_meant)
    return release::revoked;
  if (now.now_ns - what.decided_ns > order_is_worth_ns)
    return release::too_late;
  for (const auto kind : what.expected)
    modes_.expect(kind, now.now_ns);
  return release::now;
}

effects core::on_late(const order& what, instant now) {
  const std::string why = "the journal did not write in time";
  if (std::holds_alternative<failsafe::guard_mission>(what.what))
    return on_guarded(what.number, {false, why}, false, now);
  if (std::holds_alternative<vehicle_link::upload_plan>(what.what) ||
      std::holds_alternative<vehicle_link::download_plan>(what.what)) {
    transfer::outcome outcome;
    outcome.verdict = transfer::verdict::not_begun;
    outcome.holding = transfer::holding::unchanged;
    outcome.reason = why;
    return on_transfer(what.number, outcome, now);
  }
  vehicle_link::command_outcome outcome;
  outcome.verdict = vehicle_link::command_verdict::not_sent;
  outcome.reason = why;
  return on_command(what.number, outcome, now);
}

effects core::on_command(std::uint64_t number, const vehicle_link::command_outcome& outcome, instant now) {
  effects out;
  runner_.on_command(world(now, out), number, outcome);
  return out;
}

effects core::on_transfer(std::uint64_t number, const transfer::outcome& outcome, instant now) {
  effects out;
  if (number >= first_reading_back)
    take_read_back(out, number, outcome, now);
  else if (runner_.is_busy())
    runner_.on_transfer(world(now, out), number, outcome);
  else if (s_.progress.upload) // of a task that was dropped
    out.emplace_back(note{end_of(outcome)});
  return out;
}

void core::on_stance(const failsafe::stance& m) { stance_ = m; }

effects core::on_guarded(std::uint64_t number, const failsafe::guard_answer& answer, bool is_answered, instant now) {
  effects out;
  runner_.on_guarded(world(now, out), number, answer.taken ? std::string() : answer.reason, is_answered);
  return out;
}

void core::take_read_back(effects& out, std::uint64_t number, const transfer::outcome& outcome, instant now) {
  if (number != reading_back_ || (looking_ != question::read_back && looking_ != question::plan_id))
    return;
  reading_back_ = 0;
  if (outcome.verdict != transfer::verdict::accepted) {
    read_again_ns_ = now.now_ns + read_again_after_ns;
    return;
  }
  if (looking_ == question::plan_id) { // no upload goes on in the link; what the vehicle says from now on holds
    may_upload_go_on_ = false;
    looking_since_ns_ = now.now_ns;
    return;
  }
  const bool has_home = plan_has_home();
  const auto is_same = [&](const std::optional<deployment>& one) {
    return one && !io::mavlink::first_difference(one->items, outcome.items, has_home);
  };
  auto match = progress::read_back_match::other;
  if (is_same(s_.brings))
    match = progress::read_back_match::pending;
  else if (is_same(s_.flown))
    match = progress::read_back_match::before;
  looking_ = question::none;
  out.emplace_back(note{progress::plan_read_back{match}});
}

// -- the service ------------------------------------------------------------------------------------

effects core::on_mission(const mission_client::mission_loaded& m, instant) {
  refusal_.clear();
  if (s_.mission && s_.mission->mission_id == m.document.mission_id && m.document.revision <= s_.mission->revision)
    return {};
  if (s_.arrived && *s_.arrived == m.document)
    return {};
  return {note{mission_arrived{m.document}}};
}

effects core::on_refused(const mission_client::mission_refused& m, instant) {
  refusal_ = m.reason;
  return {announce{"mission " + m.mission_id + ": " + m.reason, true}};
}

effects core::on_map(const mission_client::map_pulled& m, instant) {
  map_ = m.state;
  map_problem_ = m.reason;
  return {};
}

void core::on_service(const mission_client::service_status& m) {
  if (!s_.mission || m.mission_id != s_.mission->mission_id)
    return;
  map_ = m.pull;
  if (map_ == pull_state::synced)
    map_problem_.clear();
}

bool core::wants_service() const {
  return settings_.has_service && !is_in_flight() && s_.mission && map_ != pull_state::synced &&
         !is_over(s_.standing.now);
}

effects core::on_assignment(const mission_client::assignment_arrived& m, instant) {
  const auto& wish = m.assignment;
  const bool is_known = s_.last_assignment == wish.assignment_id ||
                        std::any_of(s_.waiting.begin(), s_.waiting.end(),
                                    [&](const auto& each) { return each.assignment_id == wish.assignment_id; });
  if (is_known || !s_.mission || s_.mission->mission_id != m.mission_id)
    return {};
  if (s_.waiting.size() >= max_waiting)
    return {note{assignment_rejected{wish.assignment_id, "too many assignments wait already"}}};
  return {note{assignment_kept{wish}}};
}

effects core::on_deleted(const mission_client::mission_deleted& m, instant) {
  return {announce{"the service has deleted mission " + m.mission_id + "; what goes on goes on", true}};
}

effects core::on_delivered(const mission_client::mission_settled& m, instant) {
  effects out;
  if (s_.standing.now == phase::post_flight && s_.mission && s_.mission->mission_id == m.mission_id)
    stand(out, phase::done);
  return out;
}

// -- people -----------------------------------------------------------------------------------------

operator_words::answer core::on_operator(const operator_words::word& m, instant now) {
  using operator_words::verb;
  const auto refuse = [](const std::string& why) { return operator_words::answer{false, why}; };
  const bool belongs_to_person = is_paused_for_person();
  switch (m.verb) {
  case verb::hand_back:
    if (!is_paused_for_person())
      return refuse("nobody has taken the vehicle from godwit");
    is_handed_back_ = true;
    return {true, {}};
  case verb::acknowledge:
    acknowledged_ = preflight::acknowledged{m.report, m.by};
    return {true, {}};
  case verb::check:
    wants_checks_ = true;
    return {true, {}};
  case verb::go_to:
  case verb::cancel:
  case verb::insert:
    return belongs_to_person ? refuse("the vehicle has to be handed back first: " + s_.standing.reason)
                             : take_change(m, now);
  case verb::start:
    if (s_.standing.now != phase::ready)
      return refuse("the flight is not ready: " + sentence());
    is_start_wanted_ = true;
    return {true, {}};
  case verb::resume:
    if (s_.standing.now != phase::paused)
      return refuse("the flight is not paused: " + sentence());
    break;
  case verb::pause:
  case verb::come_home:
    if (!is_in_flight())
      return refuse("no flight is under way: " + sentence());
    break;
  }
  if (belongs_to_person)
    return refuse("the vehicle has to be handed back first: " + s_.standing.reason);
  wanted_change_.reset(); // the last word counts
  is_held_for_change_ = false;
  wanted_ = m.verb == verb::pause ? task_kind::hold : m.verb == verb::resume ? task_kind::resume : task_kind::come_home;
  return {true, {}};
}

// -- what a note has led to -------------------------------------------------------------------------

effects core::on_news(const progress::look_at_vehicle&, instant now) {
  looking_ = question::plan_id;
  looking_since_ns_ = now.now_ns;
  return {};
}

effects core::on_news(const progress::read_plan_back&, instant now) {
  looking_ = question::read_back;
  reading_back_ = 0;
  read_again_ns_ = now.now_ns;
  return {};
}

effects core::on_news(const progress::settle_start& m, instant now) {
  looking_ = question::start;
  looking_since_ns_ = now.now_ns;
  looking_for_sequence_ = m.sequence;
  return {};
}

effects core::on_news(const progress::news& m, instant) {
  using progress::news_kind;
  effects out;
  switch (m.kind) {
  case news_kind::not_at_start:
    must_choose_item_ = m.generation == s_.progress.last_generation;
    break;
  case news_kind::foreign_plan:
    stand_paused(out, pause_cause::foreign_plan, "the vehicle holds a plan that is not godwit's");
    break;
  case news_kind::vehicle_restarted:
    stand_paused(out, pause_cause::vehicle_restarted, "the autopilot started again; what it flew is lost");
    break;
  case news_kind::plan_done:
  case news_kind::mission_complete:
    if (is_in_flight() && s_.standing.now == phase::flying)
      stand(out, phase::landing);
    break;
  case news_kind::generation_opened:
  case news_kind::armed:
  case news_kind::upload_failed:
    break;
  }
  return out;
}

std::string core::sentence() const {
  const auto& at = s_.standing;
  std::string result(io::name_of(at.now));
  if (!at.reason.empty())
    result += ": " + at.reason;
  else if (at.now == phase::preflight)
    result += ": " + preflight::sentence_of(s_.preflight);
  return result;
}

// -- decisions --------------------------------------------------------------------------------------

bool core::is_paused_for_person() const {
  return s_.standing.now == phase::paused && needs_hand_back(s_.standing.cause);
}

bool core::may_change_plan() const {
  const auto& at = s_.standing;
  return at.in_flight && (at.now == phase::flying || (at.now == phase::paused && at.cause == pause_cause::asked));
}

bool core::is_plan_finished() const { return s_.progress.plan && s_.progress.plan->generation.is_finished; }

bool core::is_mission_finished() const { return is_plan_finished() && s_.progress.plan->map.ends_mission; }

bool core::is_at_plan_end() const {
  if (!s_.progress.plan)
    return false;
  const auto end = progress::end_sequence(s_.progress.plan->map);
  return is_plan_finished() || progress::is_at_last_movement(s_.progress) ||
         (view_.current() && view_.current()->seq + 1U >= end && view_.current()->seq < end);
}

// A new incarnation knows what it meant to do, and not what the vehicle does. It looks first.
bool core::recover(effects& out, instant now) {
  if (has_looked_)
    return false;
  if (!view_.is_seen() || !stance_ || awaits_place_in_plan(now))
    return true;
  has_looked_ = true;
  was_up_ = view_.is_under_way();
  for (const auto& each : progress::resume(s_.progress))
    if (std::holds_alternative<progress::look_at_vehicle>(each)) {
      static_cast<void>(on_news(progress::look_at_vehicle{}, now));
      may_upload_go_on_ = true;
    } else if (std::holds_alternative<progress::read_plan_back>(each))
      static_cast<void>(on_news(progress::read_plan_back{}, now));
    else if (const auto* start = std::get_if<progress::settle_start>(&each))
      static_cast<void>(on_news(*start, now));
  if (view_.is_under_way())
    recover_in_flight(out);
  else
    recover_on_ground(out);
  return true;
}

// A mode into which a plan may lead: the next MISSION_CURRENT says whether it did.
bool core::awaits_place_in_plan(instant now) const {
  const bool may_have_led_there = is_in_flight() && s_.standing.now != phase::paused && !s_.doing &&
                                  view_.is_under_way() && ends_plans(view_.mode()->kind);
  return may_have_led_there && !view_.current() && !is_at_plan_end() && now.now_ns - began_ns_ < last_word_within_ns;
}

// Nothing begins by itself: whoever stands beside the vehicle has seen godwit fail.
void core::recover_on_ground(effects& out) {
  if (s_.doing) {
    if (s_.doing->start_key)
      answer_start(out, *s_.doing->start_key, start_verdict::failed, "godwit was restarted before the vehicle moved");
    out.emplace_back(note{task_ended{s_.doing->number}});
  }
  const bool was_preparing = s_.doing || (is_before_start(s_.standing.now) && s_.standing.now > phase::preflight) ||
                             s_.standing.now == phase::starting;
  if (is_in_flight() || !was_preparing)
    return; // end_flight sees to it
  stand(out, phase::paused, pause_cause::restarted,
        "godwit was restarted on the ground; resume prepares the flight again");
}

// What was meant and is not done is finished by a mode change, and only out of the hold that we have commanded.
void core::recover_in_flight(effects& out) {
  const bool was_starting = s_.doing && s_.doing->kind == task_kind::start;
  const bool is_ours = is_in_flight() || was_starting;
  const auto doing = s_.doing;
  if (doing) {
    if (doing->start_key)
      answer_start(out, *doing->start_key, start_verdict::failed, "godwit was restarted while the vehicle started");
    out.emplace_back(note{task_ended{doing->number}});
  }
  modes_.adopt(*view_.mode());
  if (!is_ours || is_paused_for_person())
    return;
  must_guard_ = doing && doing->kind == task_kind::deploy;
  if (stance_->reacts || stance_->taken_over) {
    stand_as(out, phase::flying, true); // heed_others says the rest
    return;
  }
  const bool is_held = view_.is_in(mode_kind::hold);
  const bool meant_to_go_on =
      doing && (doing->kind == task_kind::resume || (doing->kind == task_kind::deploy && doing->goes_on));
  if (is_held && meant_to_go_on) {
    finishes_intent_ = true;
    stand_as(out, phase::flying, true);
  } else if (is_held && (s_.standing.cause == pause_cause::asked || (doing && doing->kind == task_kind::hold))) {
    stand(out, phase::paused, pause_cause::asked, "held as asked");
  } else if (s_.standing.now == phase::landing && ends_plans(view_.mode()->kind)) {
    stand_as(out, phase::landing, true);
  } else if (view_.is_in(mode_kind::mission) || is_at_plan_end() || (doing && doing->kind == task_kind::come_home)) {
    stand_as(out, is_plan_finished() ? phase::landing : phase::flying, true);
    if (view_.is_in(mode_kind::mission) && doing &&
        (doing->kind == task_kind::hold || doing->kind == task_kind::come_home))
      wanted_ = doing->kind; // an operator's word, which the vehicle has not heard or not shown yet
  } else {
    stand_paused(out, pause_cause::taken_over,
                 "the vehicle is in another mode (" + std::string(io::name_of(view_.mode()->kind)) +
                     ") than godwit left it in; hand it back when godwit is to go on");
  }
}

// The link takes it behind the transfer that is under way.
void core::read_back(effects& out, instant now) {
  if (reading_back_ != 0 || now.now_ns < read_again_ns_)
    return;
  reading_back_ = ++last_reading_back_;
  out.emplace_back(order{goes::after_notes, reading_back_, now.now_ns, {}, vehicle_link::download_plan{}});
}

// What an upload or a start came to, where its answer was lost.
bool core::settle(effects& out, instant now) {
  if (looking_ == question::none || (is_in_flight() && is_paused_for_person()))
    return false;
  if (!view_.is_connected())
    return true;
  const bool is_news = view_.current() && view_.current_heard_ns() > looking_since_ns_;
  switch (looking_) {
  case question::plan_id:
    if (may_upload_go_on_) {
      read_back(out, now);
      return true;
    }
    if (view_.keeps_plan_ids() && !is_news)
      return true;
    looking_ = question::none;
    out.emplace_back(note{progress::vehicle_looked_at{
        view_.keeps_plan_ids() ? std::optional(view_.current()->mission_id) : std::nullopt}});
    break;
  case question::read_back:
    read_back(out, now);
    break;
  case question::start:
    if (!is_news || !view_.mode())
      return true;
    looking_ = question::none;
    out.emplace_back(note{progress::start_ended{view_.is_armed() && view_.is_in_begun_mission()}});
    break;
  case question::none:
    break;
  }
  return true;
}

// A pilot, or a failsafe. A pilot is one who either of the two watches has seen.
bool core::heed_others(effects& out, instant now) {
  const bool is_ours_to_lose = is_in_flight() || (s_.doing && s_.doing->kind == task_kind::start);
  if (!is_ours_to_lose || is_paused_for_person() || !view_.mode()) {
    unclear_since_ns_ = 0;
    return false;
  }
  const bool led_there = is_at_plan_end() && ends_plans(view_.mode()->kind);
  if (unclear_since_ns_ != 0 && !led_there && ends_plans(view_.mode()->kind) &&
      view_.current_heard_ns() <= unclear_since_ns_ && now.now_ns - unclear_since_ns_ < last_word_within_ns)
    return true; // after a silence: whether the plan led there is told next, and nothing is sent before
  const bool has_pilot = !led_there && (unclear_since_ns_ != 0 || stance_->taken_over);
  if (unclear_since_ns_ != 0 && led_there) {
    plan_ends(out, now);
    modes_.adopt(*view_.mode());
  }
  if (led_there && stance_->taken_over) { // the failsafe does not know where the plan leads before it is told
    out.emplace_back(say_to_failsafe{failsafe::hand_back{}});
    stance_->taken_over = false;
  }
  unclear_since_ns_ = 0;
  if (stance_->reacts) {
    const auto& acts = *stance_->reacts;
    yield(out, pause_cause::failsafe,
          "a failsafe acts (" + std::string(io::name_of(acts.why)) + ": " + std::string(io::name_of(acts.what)) +
              "); nothing else is sent until an operator hands the vehicle back");
  } else if (has_pilot) {
    yield(out, pause_cause::taken_over,
          "a pilot has the vehicle (mode " + std::string(io::name_of(view_.mode()->kind)) +
              "); nothing is sent until an operator hands it back");
  } else {
    return false;
  }
  return true;
}

void core::yield(effects& out, pause_cause to, const std::string& why) {
  runner_.drop({s_, view_, modes_, 0, out});
  if (s_.doing) {
    if (s_.doing->start_key)
      answer_start(out, *s_.doing->start_key, start_verdict::failed, why);
    out.emplace_back(note{task_ended{s_.doing->number}});
  }
  asked_start_.reset();
  wanted_.reset();
  wanted_change_.reset();
  is_held_for_change_ = false;
  is_start_wanted_ = false;
  finishes_intent_ = false;
  if (to == pause_cause::taken_over && !stance_->taken_over)
    out.emplace_back(say_to_failsafe{failsafe::taken_over{}});
  if (is_in_flight())
    stand_paused(out, to, why);
  else
    out.emplace_back(note{stood{phase::paused, to, why, view_.is_under_way()}});
}

// What the plan leads to by itself is nobody's takeover; behind another plan it is again.
void core::plan_ends(effects& out, instant now) {
  modes_.set_plan_end(true);
  if (told_plan_end_ns_ != 0 && now.now_ns - told_plan_end_ns_ < plan_end_expected_ns / 2)
    return;
  told_plan_end_ns_ = now.now_ns;
  for (const auto kind : {mode_kind::hold, mode_kind::returning, mode_kind::landing})
    out.emplace_back(say_to_failsafe{failsafe::expect_mode{kind, plan_end_expected_ns / 1'000'000}});
}

bool core::run_task(effects& out, instant now) {
  const auto what = runner_.doing();
  const bool is_pointless = what && what->kind == task_kind::deploy && what->goes_on && is_plan_finished() &&
                            !s_.progress.upload && s_.progress.last_generation == deploying_over_;
  if (is_pointless) { // the plan ended before another one could take its place
    runner_.drop(world(now, out));
    out.emplace_back(note{task_ended{what->number}});
    return true;
  }
  switch (runner_.advance(world(now, out))) {
  case task_runner::verdict::idle:
    return false;
  case task_runner::verdict::under_way:
    break;
  case task_runner::verdict::done:
    task_done(out, *what, now);
    break;
  case task_runner::verdict::failed:
    task_failed(out, *what, runner_.why_failed(), now);
    break;
  }
  return true;
}

// Disarmed, or down behind the end of the plan; a rover: at the end of its plan.
bool core::is_down(instant now) const {
  if (!view_.is_armed())
    return true;
  const bool was_called_home = s_.progress.paused == progress::pause_reason::aborted;
  if (view_.owner().vehicle != flight::vehicle_class::rover)
    return is_plan_finished() && was_up_ && !view_.is_under_way();
  if (view_.is_in(mode_kind::returning)) // ArduPilot's rover stays in that mode
    return (was_called_home || is_plan_finished()) && view_.stands_at_home(now.now_ns);
  return is_plan_finished() || (was_called_home && view_.is_in(mode_kind::hold));
}

// What a Copter and PX4 do not say: that the landing, or the return, with which the plan ends is done.
bool core::was_brought_down() const {
  if (view_.is_armed() || !s_.flown || !progress::is_at_last_movement(s_.progress))
    return false;
  const auto kind = view_.mode()->kind;
  if (kind != mode_kind::mission && !ends_plans(kind))
    return false;
  using io::mavlink::mav_cmd;
  return std::ranges::any_of(std::array{mav_cmd::nav_land, mav_cmd::nav_vtol_land, mav_cmd::nav_return_to_launch},
                             [&](mav_cmd each) { return s_.flown->items.back().command == io::mavlink::number(each); });
}

bool core::end_flight(effects& out, instant now) {
  if (!view_.is_connected() || !view_.mode())
    return false;
  if (!is_in_flight()) {
    const auto at = s_.standing.now;
    const bool is_open = at == phase::paused || is_before_start(at);
    if (!is_open || s_.doing || !is_mission_finished() || !s_.mission || !has_nothing_left(*s_.mission))
      return false;
    end_mission(out); // its last word came behind the end of the flight
    return true;
  }
  if (!is_down(now)) {
    down_since_ns_ = 0;
    return false;
  }
  if (down_since_ns_ == 0)
    down_since_ns_ = now.now_ns;
  const bool is_told = is_plan_finished() || s_.progress.paused == progress::pause_reason::aborted;
  if (!is_told && now.now_ns - down_since_ns_ < last_word_within_ns)
    return false; // how far it came is told after it is down, where the line was silent before
  if (was_brought_down()) {
    out.emplace_back(note{progress::came_down{}});
    return true;
  }
  down_since_ns_ = 0;
  modes_.forget();
  told_plan_end_ns_ = 0;
  was_up_ = false;
  if (s_.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::flight_ended{}});
  if (is_mission_finished() || s_.progress.paused == progress::pause_reason::aborted) {
    end_mission(out);
  } else if (is_plan_finished()) {
    stand_as(out, phase::connected, false); // the next plan of the mission
  } else {
    out.emplace_back(note{stood{phase::paused, pause_cause::not_done,
                                "the flight ended before its plan; resume prepares the rest of it", false}});
  }
  return true;
}

void core::end_mission(effects& out) {
  if (settings_.has_service)
    out.emplace_back(say_to_client{mission_client::push_map{s_.mission->mission_id}});
  stand_as(out,
           !is_mission_finished()  ? phase::aborted
           : settings_.has_service ? phase::post_flight
                                   : phase::done,
           false);
}

} // namespace godwit::executor
