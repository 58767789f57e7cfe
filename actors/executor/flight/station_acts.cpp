#include "actors/executor/flight/station_acts.hpp"

#include <utility>

namespace godwit::executor {

act_answer station_acts::take(effects& out, const station_act& m, bool has_looked, instant now) {
  if (auto answer = arming_.take(out, m, now))
    return *std::move(answer);
  if (m.kind == act_kind::configure)
    return configure();
  if (m.kind == act_kind::hold && holds(has_looked, now))
    return {act_verdict::done, {}};
  if (is_done_already(m))
    return {act_verdict::done, {}};
  const bool is_up_next = m.kind == act_kind::arm || m.kind == act_kind::take_off;
  const bool stands = flight_.view.mode() && !flight_.view.is_armed() && !flight_.is_in_flight() &&
                      !flight_.is_starting() && !is_up_next;
  if (!stands || flight_.has_person())
    watch_.give_to_station(out, m);
  if (is_up_next)
    flight_.arming_until_ns = now.now_ns + arming_shows_within_ns;
  return {act_verdict::pass, {}};
}

act_answer station_acts::configure() {
  if (!flight_.view.mode() || !flight_.view.is_connected())
    return {act_verdict::refused, "the vehicle is not heard"};
  if (flight_.view.is_armed() || flight_.is_in_flight() || flight_.is_starting())
    return {act_verdict::refused, "not while the vehicle is armed"};
  preparation_.check_again();
  return {act_verdict::pass, {}};
}

bool station_acts::holds(bool has_looked, instant now) {
  if (flight_.has_person())
    return false;
  operators::command command;
  command.kind = operators::command_kind::pause;
  return operators_.take(command, has_looked, now).is_taken;
}

bool station_acts::is_done_already(const station_act& m) const {
  return (m.kind == act_kind::arm || m.kind == act_kind::take_off) && !flight_.has_person() &&
         flight_.view.is_armed() && (flight_.is_in_flight() || flight_.is_starting());
}

} // namespace godwit::executor
