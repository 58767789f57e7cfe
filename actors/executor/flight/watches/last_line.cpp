#include "actors/executor/flight/watches/last_line.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/plan/fence_items.hpp"
#include "actors/executor/station_plan.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_autopilot;
using io::mavlink::mav_mission_type;
namespace transfer = vehicle_link::transfer;

constexpr const char* cut_off = "it was begun and is not finished";

std::string name_of(mav_mission_type type) { return type == mav_mission_type::fence ? "fence" : "rally points"; }

} // namespace

// -- when -------------------------------------------------------------------------------------------

bool last_line::stands() const {
  return flight_.view.is_connected() && flight_.view.mode() && !flight_.view.is_armed() && !flight_.is_in_flight() &&
         !flight_.is_starting() && !flight_.has_person();
}

// The plan is on the vehicle, or there is none any more.
bool last_line::is_moment() const {
  const auto& s = flight_.s;
  const auto at = s.status.now;
  const bool has_plan = at == phase::ready && s.mission && s.flown;
  const bool has_none = !s.mission && (at == phase::connected || is_at_rest(at));
  return stands() && !s.arrived && !s.doing && !flight_.has_open_intent() && !clearing_.is_under_way() &&
         !clearing_.is_waiting() && (has_plan || has_none);
}

last_line::occasion last_line::occasion_now() const {
  const auto& s = flight_.s;
  return {s.progress.last_generation, s.mission.has_value(), s.station_fences.empty(), s.station_rally.empty()};
}

bool last_line::advance(effects& out, instant now) {
  if (!flight_.configured.brings_last_line)
    return false;
  if (!doing_) {
    say_outdated(out);
    if (!is_moment() || settled_ == occasion_now())
      return false;
    settled_ = occasion_now();
    prepare(out);
    until_ns_ = now.now_ns + last_line_within_ns;
    is_start_waiting_ = false;
    begin_next(out, now);
    return doing_.has_value();
  }
  if (flight_.wanted.start && !std::exchange(is_start_waiting_, true))
    until_ns_ = std::min(until_ns_, now.now_ns + last_line_before_start_ns);
  if (!stands() || flight_.s.arrived)
    give_up(out, cut_off);
  else if (now.now_ns >= until_ns_)
    give_up(out, "the vehicle does not answer in time");
  else if (!is_asked_ && now.now_ns >= again_ns_)
    ask(out, now);
  return doing_.has_value();
}

effects last_line::stop() {
  effects out;
  if (doing_)
    give_up(out, cut_off);
  return out;
}

// -- what -------------------------------------------------------------------------------------------

void last_line::prepare(effects& out) {
  const auto& s = flight_.s;
  waiting_.clear();
  plan::fence_list fences;
  if (s.mission) {
    fences = plan::fence_items(s.mission->geofences);
    plan::append_return_point(fences, *s.mission);
  }
  for (const auto& why : fences.left_out)
    out.emplace_back(announce{"not all fences go to the vehicle, and godwit alone watches the others: " + why, true});
  const bool is_stations = uploaded_mission(s) != nullptr;
  if (s.mission || s.station_fences.empty())
    add(mav_mission_type::fence, std::move(fences.items), s.last_line.has_fence);
  if (s.mission || s.station_rally.empty())
    add(mav_mission_type::rally,
        is_stations ? s.station_rally
        : s.mission ? plan::rally_items(*s.mission)
                    : items{},
        s.last_line.has_rally);
}

void last_line::add(mav_mission_type type, items wanted, bool was_brought) {
  if (!wanted.empty() || was_brought)
    waiting_.push_back({type, std::move(wanted)});
}

// It is noted before it goes out: whoever comes after a crash clears what may have come.
void last_line::begin_next(effects& out, instant now) {
  doing_.reset();
  reads_back_ = false;
  is_asked_ = false;
  if (waiting_.empty())
    return;
  doing_ = std::move(waiting_.front());
  waiting_.pop_front();
  if (!doing_->wanted.empty())
    note_brought(out, doing_->type, true);
  ask(out, now);
}

void last_line::note_brought(effects& out, mav_mission_type type, bool is_brought) {
  auto next = flight_.s.last_line;
  (type == mav_mission_type::fence ? next.has_fence : next.has_rally) = is_brought;
  if (!(next == flight_.s.last_line))
    out.emplace_back(note{last_line_brought{next}});
}

void last_line::ask(effects& out, instant now) {
  is_asked_ = true;
  if (reads_back_) {
    out.emplace_back(
        order{goes::after_notes, ++last_number_, now.now_ns, {}, vehicle_link::download_plan{doing_->type}});
    return;
  }
  vehicle_link::upload_plan what{doing_->type, doing_->wanted, {}};
  what.only_while = flight_.known();
  what.only_while->is_armed = false;
  out.emplace_back(order{goes::after_notes, ++last_number_, now.now_ns, {}, std::move(what)});
}

// -- what came of it --------------------------------------------------------------------------------

void last_line::on_transfer(effects& out, std::uint64_t number, const transfer::outcome& outcome, instant now) {
  if (!awaits(number))
    return;
  is_asked_ = false;
  if (outcome.verdict == transfer::verdict::not_begun) { // another one is under way, or its mode has changed
    again_ns_ = now.now_ns + last_line_again_after_ns;
    return;
  }
  if (outcome.verdict != transfer::verdict::accepted) {
    warn(out, outcome.reason);
    return begin_next(out, now);
  }
  if (reads_back_) {
    take_read_back(out, outcome.items);
    return begin_next(out, now);
  }
  if (doing_->wanted.empty()) {
    if (doing_->type == mav_mission_type::fence)
      brought_.reset();
    note_brought(out, doing_->type, false);
    return begin_next(out, now);
  }
  reads_back_ = true;
  ask(out, now);
}

void last_line::take_read_back(effects& out, const items& theirs) {
  if (io::mavlink::first_difference(doing_->wanted, theirs, false))
    return warn(out, "what was read back is not what was uploaded");
  if (doing_->type == mav_mission_type::fence)
    brought_ = flight_.s.mission ? flight_.s.mission->geofences : std::vector<mission::geofence>{};
  say_brought(out);
}

void last_line::give_up(effects& out, const std::string& why) {
  if (is_asked_)
    out.emplace_back(give_up_transfer{});
  warn(out, why);
  waiting_.clear();
  doing_.reset();
  is_asked_ = false;
}

// -- what people are told -----------------------------------------------------------------------------

void last_line::warn(effects& out, const std::string& why) {
  const auto name = name_of(doing_->type);
  const std::string what = doing_->wanted.empty() ? "the " + name + " of before may still be on the vehicle: "
                           : doing_->type == mav_mission_type::fence
                               ? "the fence is not surely on the vehicle, and godwit alone watches it: "
                               : "the rally points are not surely on the vehicle: ";
  out.emplace_back(announce{what + why, true});
}

void last_line::say_brought(effects& out) const {
  const auto autopilot = flight_.view.owner().autopilot;
  std::string result = "the " + name_of(doing_->type) + " of the mission went to the vehicle as well (" +
                       std::to_string(doing_->wanted.size()) + " items)";
  if (doing_->type == mav_mission_type::rally)
    result += "; where it uses them its returns lead to one of them, and not home";
  else if (autopilot == mav_autopilot::ardupilotmega)
    result += "; an ArduPilot enforces it only with FENCE_ENABLE set, and godwit sets no parameters";
  else if (autopilot == mav_autopilot::px4)
    result += "; GF_ACTION says what a PX4 does at it, and godwit sets no parameters";
  out.emplace_back(announce{result, doing_->type == mav_mission_type::rally});
}

// A vehicle that is outside of a fence that comes in flight acts at once.
void last_line::say_outdated(effects& out) {
  const auto& s = flight_.s;
  if (!flight_.is_in_flight() || !brought_ || !s.flown || told_outdated_ == s.progress.last_generation ||
      s.flown->mission.geofences == *brought_)
    return;
  told_outdated_ = s.progress.last_generation;
  out.emplace_back(announce{"the vehicle keeps the fence with which it took off; godwit watches the new one", true});
}

} // namespace godwit::executor
