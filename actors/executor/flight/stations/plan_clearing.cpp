#include "actors/executor/flight/stations/plan_clearing.hpp"

#include "io/mavlink/enums/mission.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
namespace {

using ground_port::plan_verdict;

send_to_port judged(plan_verdict verdict) {
  return {ground_port::plan_judged{io::mavlink::mav_mission_type::mission, 0, verdict}};
}

} // namespace

std::string plan_clearing::why_not_vehicle() const {
  if (GODWIT_PLANTED(clear_while_armed))
    return {};
  if (flight_.is_in_flight() || is_flight_begun(flight_.s))
    return "it is flown";
  if (flight_.has_person())
    return "the vehicle has to be handed back first";
  if (!flight_.view.is_connected() || !flight_.view.mode())
    return "the vehicle is not heard";
  return flight_.view.is_armed() ? "the vehicle is armed" : "";
}

std::string plan_clearing::why_never() const {
  if (GODWIT_PLANTED(clear_while_armed))
    return {};
  if (auto elsewhere = flight_.missions_come_from_elsewhere(); !elsewhere.empty())
    return elsewhere;
  return why_not_vehicle();
}

bool plan_clearing::is_busy(bool has_looked) const {
  const auto at = flight_.s.status.now;
  const bool is_between = at == phase::uploading || at == phase::starting || at == phase::post_flight;
  return !has_looked || is_between || flight_.s.doing || flight_.has_open_intent() || flight_.wanted.start ||
         flight_.authority.is_unclear();
}

void plan_clearing::refuse(effects& out, const std::string& why) {
  waits_until_ns_ = 0;
  out.emplace_back(announce{"the plan is not cleared: " + why, true});
  out.emplace_back(judged(plan_verdict::refused));
}

void plan_clearing::begin(effects& out, bool has_looked, instant now) {
  if (const auto why = why_never(); !why.empty())
    return refuse(out, why);
  if (!is_waiting())
    waits_until_ns_ = now.now_ns + waits_ns;
  look(out, has_looked, now);
}

void plan_clearing::look(effects& out, bool has_looked, instant now) {
  if (!is_waiting())
    return;
  if (const auto why = why_never(); !why.empty())
    refuse(out, why);
  else if (!is_busy(has_looked) || GODWIT_PLANTED(clear_while_armed))
    clear(out, now);
  else if (now.now_ns >= waits_until_ns_)
    refuse(out, "something else is under way: " + flight_.sentence());
}

void plan_clearing::clear(effects& out, instant now) {
  waits_until_ns_ = 0;
  drop_plan(out);
  if (is_under_way_)
    return;
  is_under_way_ = true;
  vehicle_link::upload_plan nothing; // no items: the vehicle's plan is cleared
  nothing.only_while = flight_.known();
  out.emplace_back(order{goes::after_notes, ++last_number_, now.now_ns, {}, std::move(nothing)});
}

void plan_clearing::drop_plan(effects& out) {
  const auto& s = flight_.s;
  if (!s.mission && !s.arrived && !s.station && !s.flown)
    return;
  out.emplace_back(note{station_plan_dropped{}});
  phases_.go(out, trigger::mission_changed);
}

void plan_clearing::on_transfer(effects& out, std::uint64_t number, const vehicle_link::transfer::outcome& outcome) {
  if (!awaits(number))
    return;
  is_under_way_ = false;
  if (outcome.verdict == vehicle_link::transfer::verdict::accepted) {
    out.emplace_back(judged(plan_verdict::taken));
    return;
  }
  out.emplace_back(announce{"the plan is cleared here, and may still be on the vehicle: " + outcome.reason, true});
  out.emplace_back(judged(plan_verdict::failed));
}

} // namespace godwit::executor
