#include "actors/executor/flight/stations/upload_in_flight.hpp"

#include <algorithm>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/executor/station_plan.hpp"

namespace godwit::executor {
namespace {

// After the take-off with which it begins: the vehicle is in the air.
std::size_t first_in_air(const mission::document& mission) {
  const auto& items = mission.items;
  const auto moves = std::ranges::find_if(items, mission::moves_vehicle);
  const bool takes_off = moves != items.end() && mission::is_take_off(*moves);
  return takes_off ? static_cast<std::size_t>(moves - items.begin()) + 1 : 0;
}

} // namespace

std::string upload_in_flight::why_not(const station& by, bool has_looked) const {
  const auto& s = flight_.s;
  if (flight_.has_person())
    return "the vehicle has to be handed back first";
  if (!s.station || s.station->by != by)
    return "another one is flown, which is not this station's; upload it after the flight";
  if (!flies_upload(s))
    return "what is flown was changed since this station's upload (a go to, an insert); upload it after the flight";
  const bool waits = s.status.now == phase::paused && flight_.may_change_plan();
  if (!waits || !flight_.view.is_under_way())
    return "it is flown: pause it, then upload, then start. It stands otherwise now: " + flight_.sentence();
  if (!has_looked || flight_.runner.is_busy() || flight_.has_open_intent() || flight_.authority.is_unclear() ||
      flight_.wanted.start || flight_.wanted.go_on || flight_.wanted.halt || flight_.wanted.change)
    return "something else is under way: " + flight_.sentence();
  return flight_.is_journal_nearly_full ? "the plan is not changed while so much waits for the journal's disk" : "";
}

bool upload_in_flight::is_under_way() const {
  const auto& doing = flight_.runner.doing();
  return flight_.is_in_flight() && doing && doing->kind == task_kind::deploy && !doing->goes_on;
}

std::string upload_in_flight::begin(effects& out, const station_plan_taken& next, instant now) {
  const auto first = flight_.is_in_air() ? first_in_air(next.mission) : 0;
  if (first >= next.mission.items.size())
    return "nothing of it is left to fly in the air";
  const auto plan = flight_.plan_in_flight(next.mission, first, now);
  if (!plan)
    return plan.error();
  tasks_.begin_upload(out, next, *plan);
  return {};
}

} // namespace godwit::executor
