#include "actors/executor/flight/stations/upload_on_ground.hpp"

#include <utility>

#include "actors/executor/station_part.hpp"
#include "actors/executor/station_plan.hpp"
#include "actors/executor/tasks/upload_tries.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {

bool upload_on_ground::begin(effects& out, std::uint32_t plan_id, instant now) {
  if (awaited_)
    resolve(out, verdict::taken); // another one has taken its place
  const auto at = flight_.s.status.now;
  const bool is_brought = at == phase::connected || at == phase::preflight || at == phase::ready || is_at_rest(at);
  if (!flight_.view.is_connected() || flight_.has_person() || flight_.view.is_armed() || !is_brought)
    return false;
  awaited next{plan_id, now.now_ns + judged_after_ns, {}, {}};
  if (flies_upload(flight_.s))
    next.before = part_of_plan(flight_.s, whole_plan(flight_.s), !flight_.drives());
  awaited_ = std::move(next);
  return true;
}

void upload_on_ground::on_transfer(const vehicle_link::transfer::outcome& outcome) {
  if (awaited_ && outcome.verdict == vehicle_link::transfer::verdict::refused)
    awaited_->is_refused = has_no_room(outcome) ? verdict::no_space : verdict::refused;
}

bool upload_on_ground::look(effects& out, instant now) {
  if (!awaited_)
    return false;
  const bool is_there = flight_.s.status.now == phase::ready && !flight_.s.arrived && flight_.s.station &&
                        flight_.s.station->plan_id == awaited_->plan_id;
  if (awaited_->is_refused && flight_.runner.is_busy())
    return false;
  if (awaited_->is_refused) {
    const auto before = std::move(awaited_->before);
    const auto how = *awaited_->is_refused;
    if (before)
      out.emplace_back(note{as_new_mission(*before, now.wall_ns)});
    else
      out.emplace_back(note{station_plan_dropped{}});
    if (flight_.s.status.now == phase::paused && !flight_.has_person())
      phases_.go(out, trigger::mission_changed);
    resolve(out, how);
    return true;
  }
  if (is_there || now.now_ns >= awaited_->until_ns)
    resolve(out, verdict::taken);
  return false;
}

void upload_on_ground::resolve(effects& out, verdict how) {
  const auto what = std::exchange(awaited_, {});
  out.emplace_back(send_to_port{ground_port::plan_judged{io::mavlink::mav_mission_type::mission, what->plan_id, how}});
}

} // namespace godwit::executor
