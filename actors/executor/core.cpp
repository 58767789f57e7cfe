#include "actors/executor/core.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/remaining.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
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
constexpr std::int64_t stands_ns = 2'000'000'000; // disarmed for so long, before its mode is changed
constexpr double landed_there_m = 15;
constexpr double fixed_wing_landed_there_m = 150;
constexpr std::int64_t last_word_within_ns = 4'000'000'000; // MISSION_CURRENT comes once a second, and may be lost

bool is_before_start(phase now) {
  return now == phase::disconnected || now == phase::connected || now == phase::preflight || now == phase::uploading ||
         now == phase::ready;
}

void append(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

bool can_be_stopped(task_kind kind) {
  return kind == task_kind::deploy || kind == task_kind::start || kind == task_kind::resume;
}

} // namespace

effects core::on_start() {
  last_task_before_ = s_.last_task;
  if (const auto& plan = s_.progress.plan) // what was to be done about it died with the incarnation that was told
    must_choose_item_ = plan->generation.is_not_at_start_told && !plan->generation.is_armed;
  effects out;
  const bool is_fresh = !s_.doing && !is_in_flight() && !has_open_intent();
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
    static_cast<void>(recover(out, now) || heed_others(out, now) || stop(out, now) || settle(out, now) ||
                      run_task(out, now) || end_flight(out, now) || leave_mission_mode(out, now) ||
                      answer_assignment(out, now) || deploy_arrived(out, now) || follow_started(out) ||
                      begin_wished(out, now) || prepare(out, now));
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
  if (view_.is_armed()) {
    disarmed_since_ns_ = 0;
    was_armed_ = true;
    has_stood_by_ = false;
  } else if (disarmed_since_ns_ == 0) {
    disarmed_since_ns_ = now.now_ns;
  }
  const bool is_failsafes = stance_ && stance_->reacts;
  if (!has_looked_ || is_failsafes || !(is_starting() || is_in_flight()))
    return {};
  know_plan_end();
  if (is_in_flight() && !view_.is_armed())
    authority_.expect_also(modes_behind_disarm(), now.now_ns, now.now_ns + flight::order_is_expected_ns);
  judge_mode(now);
  return {};
}

void core::judge_mode(instant now) {
  authority_.on_mode(view_.owner(), *view_.mode(), view_.is_critical(), now.now_ns);
}

void core::judge_place(instant now) {
  if (view_.current())
    authority_.on_place(view_.current()->seq, view_.says_complete(), now.now_ns);
}

// PX4 goes back to its mission mode when it disarms in another one, or holds when the mission is done.
std::vector<std::uint32_t> core::modes_behind_disarm() const {
  if (view_.owner().autopilot != io::mavlink::mav_autopilot::px4)
    return {};
  auto result = flight::modes_obeying(view_.owner(), mode_kind::mission);
  append(result, flight::modes_obeying(view_.owner(), mode_kind::hold));
  return result;
}

// Of the plan that was accepted last.
void core::know_plan_end() {
  if (!view_.mode() || known_end_ == s_.progress.last_generation)
    return;
  known_end_ = s_.progress.last_generation;
  authority_.set_plan_end(end_of_plan(view_.owner(), s_));
}

effects core::on_vehicle(const io::mavlink::mission_current& m, instant now) {
  view_.take(m, now.now_ns);
  know_plan_end();
  judge_place(now);
  effects out;
  progress::current_told told{m, !view_.is_armed(), !has_person() && authority_.is_ours()};
  if (view_.says_complete() && !is_complete_credible(now))
    told.message.mission_state = io::mavlink::number(io::mavlink::mission_state::active);
  if (s_.progress.plan && progress::matters(s_.progress, told, now.wall_ns))
    out.emplace_back(note{told});
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_item_reached& m, instant now) {
  effects out;
  const bool is_early =
      ends_on_ground() && m.seq >= end_of_plan(view_.owner(), s_).from_sequence && !came_down_as_planned(now);
  const progress::reached_told told{m.seq};
  if (!is_early && !has_person() && authority_.is_ours() && s_.progress.plan &&
      progress::matters(s_.progress, told, now.wall_ns))
    out.emplace_back(note{told});
  return out;
}

// A rover drives home and stays as it is.
bool core::ends_on_ground() const {
  return s_.flown && !s_.flown->items.empty() && view_.owner().vehicle != flight::vehicle_class::rover &&
         flight::leads_down(s_.flown->items.back().command);
}

// PX4 says that a plan is complete as its return begins, and behind any landing. It is when the vehicle is where the
// plan leads: on the ground there, or in the air in a mode of the plan.
bool core::is_complete_credible(instant now) const {
  if (!s_.flown || view_.owner().vehicle == flight::vehicle_class::rover)
    return true;
  if (ends_on_ground())
    return came_down_as_planned(now);
  const bool flies_plan = view_.is_in(mode_kind::mission) || view_.is_in_one_of(end_of_plan(view_.owner(), s_).modes);
  return flies_plan && view_.is_under_way();
}

// On the ground, where the last item of the plan leads.
bool core::came_down_as_planned(instant now) const {
  if (!ends_on_ground() || view_.is_under_way())
    return false;
  const auto& last = s_.flown->items.back();
  const bool is_wing = view_.owner().vehicle == flight::vehicle_class::fixed_wing;
  const auto metres = is_wing ? fixed_wing_landed_there_m : landed_there_m;
  if (last.command == io::mavlink::number(io::mavlink::mav_cmd::nav_return_to_launch))
    return view_.home() && view_.is_within(metres, {view_.home()->latitude, view_.home()->longitude}, now.now_ns);
  constexpr double units = io::mavlink::units_of(io::mavlink::coordinate_kind::global);
  return (last.x == 0 && last.y == 0) || view_.is_within(metres, {last.x / units, last.y / units}, now.now_ns);
}

core::release core::lets_out(const order& what, instant now) {
  const bool is_meant = what.number >= first_reading_back ? what.number == reading_back_ : runner_.awaits(what.number);
  if (!is_meant)
    return release::revoked;
  if (now.now_ns - what.decided_ns > order_is_worth_ns || authority_.is_unclear() ||
      (what.number < first_reading_back && !runner_.may_go_out(view_)))
    return release::too_late;
  if (!what.expected.empty())
    authority_.expect(what.expected, now.now_ns + flight::order_is_expected_ns);
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
  const auto doing = runner_.doing();
  const bool moves = doing && (doing->kind == task_kind::start || doing->kind == task_kind::resume);
  // What lets the vehicle move is not said again by itself when the disk writes at last: a person may stand there.
  outcome.verdict = moves ? vehicle_link::command_verdict::invalid : vehicle_link::command_verdict::not_sent;
  outcome.reason = why;
  return on_command(what.number, outcome, now);
}

// It was given up before it went out, and so nobody answers it.
effects core::on_revoked(const order& what) {
  if (!std::holds_alternative<vehicle_link::upload_plan>(what.what) || !s_.progress.upload ||
      (runner_.doing() && runner_.doing()->kind == task_kind::deploy))
    return {};
  return {note{progress::upload_ended{progress::upload_verdict::unchanged, {}, "it was given up"}}};
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
  else if (runner_.awaits(number))
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
    stand(out, phase::done, s_.standing.cause, s_.standing.reason);
  return out;
}

// -- people -----------------------------------------------------------------------------------------

operator_words::answer core::on_operator(const operator_words::word& m, instant now) {
  using operator_words::verb;
  const auto refuse = [](const std::string& why) { return operator_words::answer{false, why}; };
  const bool drives_plan = view_.is_under_way() && view_.is_in(mode_kind::mission);
  switch (m.verb) {
  case verb::hand_back:
    if (!has_person())
      return refuse("nobody has taken the vehicle from godwit");
    if (!has_looked_ || !view_.is_connected() || !view_.mode())
      return refuse("the vehicle is not heard, so nobody knows who has it; say it again when it is");
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
    return has_person() ? refuse("the vehicle has to be handed back first: " + s_.standing.reason)
                        : take_change(m, now);
  case verb::start:
    if (s_.standing.now != phase::ready)
      return refuse("the flight is not ready: " + sentence());
    is_start_wanted_ = true;
    return {true, {}};
  case verb::resume:
    if (s_.standing.now != phase::paused)
      return refuse("the flight is not paused: " + sentence());
    if (is_in_flight() && !view_.is_under_way())
      return refuse("the vehicle stands on the ground; say it again when its flight has ended, in a few seconds");
    if (is_in_flight() && (is_plan_finished() || s_.progress.paused == progress::pause_reason::aborted))
      return refuse("nothing of the mission is left to fly; come_home brings the vehicle back");
    break;
  case verb::pause:
  case verb::come_home:
    if (!is_in_flight() && !drives_plan && !is_starting())
      return refuse("no flight is under way: " + sentence());
    break;
  }
  if (has_person())
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

effects core::on_news(const progress::settle_start&, instant now) {
  looking_ = question::start;
  looking_since_ns_ = now.now_ns;
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

bool core::may_change_plan() const {
  const auto& at = s_.standing;
  return at.in_flight && (at.now == phase::flying || (at.now == phase::paused && at.cause == pause_cause::asked) ||
                          (at.now == phase::landing && hovers()));
}

// Behind a plan that ends in the air, or on a way that a rover has driven: it can be sent elsewhere.
bool core::hovers() const {
  return is_plan_finished() && !ends_on_ground() && view_.is_under_way() &&
         s_.progress.paused != progress::pause_reason::aborted;
}

bool core::is_plan_finished() const { return s_.progress.plan && s_.progress.plan->generation.is_finished; }

bool core::is_mission_finished() const { return is_plan_finished() && s_.progress.plan->map.ends_mission; }

// A new incarnation knows what it meant to do, and not what the vehicle does. It looks first.
bool core::recover(effects& out, instant now) {
  if (has_looked_)
    return false;
  if (!view_.is_seen() || !stance_)
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
    recover_in_flight(out, now);
  else
    recover_on_ground(out, now);
  return true;
}

// Nothing begins by itself: whoever stands beside the vehicle has seen godwit fail.
void core::recover_on_ground(effects& out, instant now) {
  if (is_in_flight() && !has_person()) { // it has come down meanwhile: by itself, or by somebody
    auto modes = left_in(s_.doing);
    append(modes, end_of_plan(view_.owner(), s_).modes);
    append(modes, modes_behind_disarm());
    authority_.resume(std::move(modes), now.now_ns);
    judge_mode(now);
  }
  end_task(out, "godwit was restarted before the vehicle moved");
  const bool was_preparing = s_.doing || (is_before_start(s_.standing.now) && s_.standing.now > phase::preflight) ||
                             s_.standing.now == phase::starting;
  if (is_in_flight() || !was_preparing)
    return; // end_flight sees to it
  stand(out, phase::paused, pause_cause::restarted,
        "godwit was restarted on the ground; resume prepares the flight again");
}

// Where the vehicle may be, when nobody else has touched it since.
std::vector<std::uint32_t> core::left_in(const std::optional<task>& doing) const {
  const auto& whose = view_.owner();
  const auto holds = flight::modes_obeying(whose, mode_kind::hold);
  const auto returns = flight::modes_obeying(whose, mode_kind::returning);
  auto result = flight::modes_of_start(whose);
  const auto at = s_.standing.now;
  const bool was_held = at == phase::paused && s_.standing.cause == pause_cause::asked;
  if (was_held && !doing)
    return holds;
  if (was_held || at == phase::paused || (doing && doing->kind != task_kind::come_home))
    append(result, holds);
  if ((doing && doing->kind == task_kind::come_home) || s_.progress.paused == progress::pause_reason::aborted)
    append(result, returns);
  if (s_.progress.paused == progress::pause_reason::aborted)
    append(result, holds); // a rover that has come home
  if (at == phase::landing)
    append(result, end_of_plan(whose, s_).modes);
  return result;
}

// What was meant and is not done is finished by a mode change, and only out of the hold that we have commanded.
void core::recover_in_flight(effects& out, instant now) {
  const auto doing = s_.doing;
  const bool was_starting = is_starting();
  if (was_starting && !is_in_flight() && !view_.is_moving())
    return recover_on_ground(out, now); // a rover that is armed and stands
  end_task(out, "godwit was restarted while the vehicle started");
  if (!(is_in_flight() || was_starting) || has_person())
    return;
  must_guard_ = doing && doing->kind == task_kind::deploy;
  if (stance_->reacts || stance_->taken_over) {
    stand_as(out, phase::flying, true); // heed_others says the rest
    return;
  }
  know_plan_end();
  authority_.resume(left_in(doing), now.now_ns);
  judge_place(now);
  judge_mode(now);
  const bool is_held = authority_.is_ours() && view_.obeys(mode_kind::hold);
  const bool meant_to_go_on =
      doing && (doing->kind == task_kind::resume || (doing->kind == task_kind::deploy && doing->goes_on));
  if (is_held && meant_to_go_on) {
    finishes_intent_ = true;
    stand_as(out, phase::flying, true);
  } else if (is_held && (s_.standing.cause == pause_cause::asked || (doing && doing->kind == task_kind::hold))) {
    stand(out, phase::paused, pause_cause::asked, "held as asked");
  } else if (s_.standing.now == phase::landing || !authority_.is_ours() || authority_.is_unclear()) {
    stand_as(out, s_.standing.now == phase::landing ? phase::landing : phase::flying,
             true); // heed_others says the rest
  } else {
    stand_as(out, is_plan_finished() ? phase::landing : phase::flying, true);
    if (view_.is_in(mode_kind::mission) && doing &&
        (doing->kind == task_kind::hold || doing->kind == task_kind::come_home))
      wanted_ = doing->kind; // an operator's word, which the vehicle has not heard or not shown yet
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
  if (looking_ == question::none || (is_in_flight() && has_person()))
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

// Whoever has the vehicle besides godwit. A person is one whom either of the two watches has seen, ours or the
// failsafe's; while it is unclear who has it nothing is sent.
bool core::heed_others(effects& out, instant now) {
  const bool is_ours_to_lose = is_in_flight() || is_starting();
  if (!is_ours_to_lose && has_person() && stance_ && stance_->in_flight && !stance_->taken_over) {
    say_taken_over(out); // a flight that nobody has handed to us
    return true;
  }
  if (!is_ours_to_lose || has_person())
    return false;
  if (!view_.mode()) // not heard: a pilot may have it, and nothing is said again but a stop
    return runner_.is_busy() && !runner_.is_stop();
  authority_.on_time(now.now_ns);
  const std::string mode(io::name_of(view_.mode()->kind));
  if (stance_->reacts) {
    const auto& acts = *stance_->reacts;
    yield(out, pause_cause::failsafe,
          "a failsafe acts (" + std::string(io::name_of(acts.why)) + ": " + std::string(io::name_of(acts.what)) +
              "); nothing else is sent until an operator hands the vehicle back");
  } else if (authority_.who() == flight::holder::autopilot_failsafe) {
    yield(out, pause_cause::autopilot_failsafe,
          "the autopilot's own failsafe acts (mode " + mode + "); nothing is sent until an operator hands it back");
  } else if (is_starting() && was_armed_ && !view_.is_armed()) {
    yield(out, pause_cause::taken_over,
          "the vehicle was disarmed while it was started, and not by godwit; nothing is sent until an operator hands "
          "it back");
  } else if (!authority_.is_ours() || stance_->taken_over) {
    yield(out, pause_cause::taken_over,
          "a pilot has the vehicle (mode " + mode + "); nothing is sent until an operator hands it back");
  } else {
    return authority_.is_unclear();
  }
  return true;
}

// The task that the record has. WHY: for the station that waits for its start.
void core::end_task(effects& out, const std::string& why) {
  if (!s_.doing)
    return;
  if (s_.doing->start_key)
    answer_start(out, *s_.doing->start_key, start_verdict::failed, why);
  out.emplace_back(note{task_ended{s_.doing->number}});
}

void core::yield(effects& out, pause_cause to, const std::string& why) {
  runner_.drop({s_, view_, authority_, 0, out});
  end_task(out, why);
  asked_start_.reset();
  wanted_.reset();
  wanted_change_.reset();
  is_held_for_change_ = false;
  is_start_wanted_ = false;
  finishes_intent_ = false;
  if (to != pause_cause::failsafe && !stance_->taken_over)
    say_taken_over(out);
  stand(out, {phase::paused, to, why, is_in_flight() || view_.is_moving()});
}

void core::say_taken_over(effects& out) {
  stance_->taken_over = true;
  out.emplace_back(say_to_failsafe{failsafe::taken_over{}});
}

// A word that holds or returns does not wait for what is under way: that is given up. Before the vehicle has moved
// there is nothing to hold, and the start ends.
bool core::stop(effects& out, instant now) {
  if (runner_.is_busy() && runner_.is_stop())
    return run_task(out, now);
  const bool is_stop = wanted_ == task_kind::hold || wanted_ == task_kind::come_home;
  const auto doing = runner_.doing();
  if (!is_stop || has_person() || (doing && !can_be_stopped(doing->kind)))
    return false;
  if (!doing)
    return begin_wanted(out, *std::exchange(wanted_, {}), now);
  const bool has_armed = runner_.has_armed() && view_.is_armed();
  const bool may_move = is_in_flight() || view_.is_moving() || runner_.has_asked_to_start();
  runner_.drop(world(now, out));
  gave_up_order_ = true;
  end_task(out, "an operator has stopped it");
  if (may_move) { // a start may still come through: it is held as what flies
    was_up_ = was_up_ || view_.is_under_way();
    if (!is_in_flight())
      stand_as(out, phase::flying, true);
    return true;
  }
  wanted_.reset();
  authority_.end();
  stand_paused(out, pause_cause::asked, "stopped before it moved; resume prepares the flight again");
  if (has_armed)
    begin(out, task_kind::stand_down, {disarm{}});
  return true;
}

bool core::run_task(effects& out, instant now) {
  const auto what = runner_.doing();
  const bool is_pointless = what && what->kind == task_kind::deploy && what->goes_on && is_plan_finished() &&
                            !deploys_behind_end_ && !s_.progress.upload &&
                            s_.progress.last_generation == deploying_over_;
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
    task_done(out, *what);
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
bool core::was_brought_down(instant now) const {
  return !view_.is_armed() && !has_person() && authority_.is_ours() && progress::is_at_last_movement(s_.progress) &&
         came_down_as_planned(now);
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
  if (was_brought_down(now)) {
    out.emplace_back(note{progress::came_down{}});
    return true;
  }
  down_since_ns_ = 0;
  authority_.end();
  known_end_.reset();
  was_up_ = false;
  if (s_.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::flight_ended{}});
  if (is_mission_finished() || s_.progress.paused == progress::pause_reason::aborted) {
    end_mission(out);
  } else if (has_person()) {
    stand(out, {phase::paused, s_.standing.cause,
                "the flight ended under somebody else; nothing is brought, armed or started until an operator hands "
                "the vehicle back",
                false});
  } else if (is_plan_finished()) {
    stand_as(out, phase::connected, false); // the next plan of the mission
  } else {
    stand(out, {phase::paused, pause_cause::taken_over,
                "the flight ended before its plan, and not by godwit; look at the vehicle and hand it back, then "
                "resume prepares the rest",
                false});
  }
  return true;
}

// Whoever arms a vehicle that stands in its mission mode is run over: PX4 goes back into it when it disarms, ArduPilot
// stays in it. The only thing that is sent to a vehicle that somebody else has, and never while it is armed.
bool core::leave_mission_mode(effects& out, instant now) {
  const bool is_our_plan = s_.flown && s_.progress.paused != progress::pause_reason::vehicle_restarted &&
                           s_.progress.paused != progress::pause_reason::foreign_plan;
  if (is_in_flight() || runner_.is_busy() || has_stood_by_ || !is_our_plan || !view_.is_connected())
    return false;
  if (!view_.is_in(mode_kind::mission) || view_.is_armed() || disarmed_since_ns_ == 0 ||
      now.now_ns - disarmed_since_ns_ < stands_ns)
    return false;
  has_stood_by_ = true;
  begin(out, task_kind::stand_by, {stand_by{}});
  return true;
}

// Who has the vehicle still has it behind the end of the mission: the next one waits for a hand-back.
void core::end_mission(effects& out) {
  if (settings_.has_service)
    out.emplace_back(say_to_client{mission_client::push_map{s_.mission->mission_id}});
  const auto over = !is_mission_finished() ? phase::aborted : settings_.has_service ? phase::post_flight : phase::done;
  const auto reason = has_person() ? "somebody else has the vehicle; hand it back before another mission" : "";
  stand(out, {over, has_person() ? s_.standing.cause : pause_cause::none, reason, false});
}

} // namespace godwit::executor
