#include "actors/executor/flight/watches/ground_watch.hpp"

#include <utility>

#include "actors/domain/home/home.hpp"

namespace godwit::executor {

bool ground_watch::is_watched() const {
  const auto at = flight_.s.status.now;
  return (at == phase::uploading || at == phase::ready) && !flight_.is_in_flight() && !flight_.is_starting() &&
         !flight_.has_person();
}

// An upload to a vehicle that stands in its mission mode takes it out of that first, and changes nothing after that.
bool ground_watch::changes_mode() const {
  const auto& doing = flight_.runner.doing();
  return doing && (doing->kind != task_kind::deploy || flight_.runner.is_standing_by());
}

void ground_watch::on_task() {
  if (changes_mode())
    mode_.reset();
  else if (!mode_ && flight_.view.mode())
    mode_ = flight_.view.mode()->custom_mode;
}

void ground_watch::on_mode(effects& out, instant now) {
  const auto& mode = flight_.view.mode();
  if (!mode || changes_mode())
    return mode_.reset();
  const auto before = std::exchange(mode_, mode->custom_mode);
  if (!before || *before == mode->custom_mode)
    return;
  if (is_watched() || flight_.s.status.now == phase::preflight)
    flight_.evidence.commanded_ns = now.now_ns;
  on_act(out);
}

void ground_watch::on_home(effects& out, instant now) {
  const auto& view = flight_.view;
  const auto& flown = flight_.s.flown;
  const bool is_moved = flown && flown->home && view.home() &&
                        flight::is_moved(plan::place_of(*view.home()), *flown->home) &&
                        !view.stands_at_home(now.now_ns);
  if (is_moved)
    on_act(out);
}

void ground_watch::on_act(effects& out) {
  const bool starts_by_itself = flight_.configured.start == start_policy::automatic;
  if (is_watched() && starts_by_itself && !flight_.s.awaits_person)
    out.emplace_back(note{person_acted{}});
}

} // namespace godwit::executor
