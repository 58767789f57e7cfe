#include "actors/executor/flight/stations/start_by_arming.hpp"

#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"

namespace godwit::executor {

void start_by_arming::begin(effects& out, const start_mission& asked, std::uint16_t sequence, instant now) {
  flight_.awaited_arming = arming_awaited{asked.asked_by, sequence, now.now_ns + arm_within_ns};
  tasks_.begin(out, task_kind::await_arming, {await_arming{}}, false, asked.key);
}

std::optional<act_answer> start_by_arming::take(effects& out, const station_act& m, instant now) {
  look(out, now);
  if (!flight_.awaited_arming || m.kind == act_kind::configure)
    return std::nullopt;
  if (m.kind == act_kind::arm && m.by == flight_.awaited_arming->by)
    return start(out, now);
  if (m.kind == act_kind::arm)
    return act_answer{act_verdict::refused,
                      "the vehicle would start its mission: " + name_of(flight_.awaited_arming->by) +
                          " has put it in its mission mode, and arms it"};
  return std::nullopt; // what the vehicle accepts of it ends the waiting (station_acts.cpp)
}

act_answer start_by_arming::start(effects& out, instant now) {
  const auto awaited = *std::exchange(flight_.awaited_arming, {});
  if (auto why = preparation_.why_not_start(out, now); !why.empty())
    return {act_verdict::refused, "the mission is not started: " + why};
  // Who watches from the arming on has not seen the mode that it waited in: it comes once more, after the start.
  const auto modes = flight::modes_obeying(flight_.view.owner(), flight::mode_kind::mission);
  out.emplace_back(send_to_failsafe{failsafe::expect_mode{modes, 0, true}});
  flight_.wanted.start.emplace();
  flight_.wanted.start->armed_from = awaited.sequence;
  return {act_verdict::done, {}};
}

void start_by_arming::look(effects& out, instant now) {
  const auto& view = flight_.view;
  if (!flight_.awaited_arming)
    return;
  const bool is_put_there = flight_.runner.doing() && flight_.runner.doing()->kind == task_kind::await_arming;
  const bool stands_there = view.mode() && view.is_in(flight::mode_kind::mission);
  const bool is_void = flight_.s.status.now != phase::ready || flight_.has_person() || view.is_armed() ||
                       !(is_put_there || stands_there);
  const bool is_late = now.now_ns >= flight_.awaited_arming->until_ns;
  if (is_late && !is_void)
    out.emplace_back(announce{"the mission is not started: the vehicle was not armed within 15 s", true});
  if (is_late || is_void)
    flight_.awaited_arming.reset();
}

} // namespace godwit::executor
