#include "actors/executor/flight/watches/plan_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "actors/executor/tasks/plan_proof.hpp"

namespace godwit::executor {

namespace transfer = vehicle_link::transfer;

// After a silence: what a start in it has led to is known by then.
constexpr std::int64_t heard_again_ns = 10'000'000'000;

void plan_watch::on_position(instant now) {
  if (const auto at = flight_.view.place(now.now_ns))
    track_.on_position({at->latitude, at->longitude}, now.now_ns);
}

bool plan_watch::is_start_heard() const { return start_ns_ != 0 && flight_.view.unbroken_since_ns() <= start_ns_; }

// Of a vehicle that is found on its way or just heard again, and in a new incarnation, nobody has seen when the place
// before was left: nothing is contradicted until it has seen one. Before a heartbeat it does not know what the vehicle
// is.
void plan_watch::follow_plan(instant now) {
  const auto& s = flight_.s;
  const bool had_start = std::exchange(has_start_, s.progress.start.has_value());
  if (!s.progress.plan || !s.flown || !flight_.view.mode())
    return;
  const auto& g = s.progress.plan->generation;
  if (has_start_ && !had_start)
    start_ns_ = now.now_ns;
  if (followed_ != g.number) {
    const auto again_ns = flight_.view.unbroken_since_ns();
    const bool is_by_start = g.origin == progress::generation_origin::start;
    const bool was_heard_at_start = is_by_start && is_start_heard();
    const bool is_just_heard = again_ns != 0 && now.now_ns - again_ns < heard_again_ns && !was_heard_at_start;
    const bool is_unseen = is_by_start && start_ns_ == 0; // that start was the incarnation's before
    const bool is_found = g.is_found || is_just_heard || is_unseen || (!followed_ && g.is_armed);
    const bool was_seen = g.is_found && was_heard_at_start && followed_; // where it was since counts
    if (!was_seen)
      track_.begin(s.flown->items, flight_.view.owner().vehicle, flight_.configured.own_loiter_radius_m,
                   is_found ? 0 : now.now_ns);
    followed_ = g.number;
    resolved_ = g.resolved;
    was_heard_at_start_ = was_heard_at_start;
    start_ns_ = 0;
  }
  if (resolved_ != g.resolved)
    track_.on_left(now.now_ns);
  resolved_ = g.resolved;
}

// Of a mission that was called off the way home is read as well, which progress does not follow.
bool plan_watch::may_read() const {
  const auto& s = flight_.s;
  const bool is_way_home =
      flight_.was_called_home() && flight_.is_on_way_home() && s.status.cause != pause_cause::foreign_plan;
  return flight_.is_in_flight() && !flight_.has_person() && !flight_.has_open_intent() && s.progress.plan && s.flown &&
         (!s.progress.paused || is_way_home) && s.cut_off_uploads == 0 && flight_.view.is_connected() &&
         flight_.evidence.plan.is_doubted();
}

void plan_watch::check(effects& out, instant now) {
  follow_plan(now);
  const auto& plan = flight_.s.progress.plan;
  const auto& current = flight_.view.current();
  if (plan && plan->vehicle_plan_id && flight_.was_called_home() && current && current->mission_id != 0 &&
      current->mission_id != *plan->vehicle_plan_id)
    flight_.evidence.plan.doubt(flight_.view.current_heard_ns());
  if (flight_.runner.is_busy()) {
    if (std::exchange(reading_, 0) != 0)
      out.emplace_back(give_up_transfer{});
    next_ns_ = now.now_ns + read_again_ns;
    return;
  }
  if (reading_ != 0 || now.now_ns < next_ns_ || !may_read())
    return;
  reading_ = ++last_number_;
  begun_ns_ = now.now_ns;
  out.emplace_back(order{goes::at_once, reading_, now.now_ns, {}, proof_request(*flight_.s.progress.plan)});
}

void plan_watch::on_transfer(effects& out, std::uint64_t number, const transfer::outcome& outcome, instant now) {
  if (number != reading_)
    return;
  reading_ = 0;
  next_ns_ = now.now_ns + read_again_ns;
  if (!may_read())
    return;
  auto& plan = flight_.evidence.plan;
  if (outcome.verdict != transfer::verdict::accepted) {
    if (!is_told_ && now.now_ns - plan.doubted_ns() > told_after_ns) {
      is_told_ = true;
      out.emplace_back(announce{"it can not be read whether the vehicle still flies godwit's plan: " + outcome.reason +
                                    ". Somebody else may have uploaded another one; watch the vehicle.",
                                true});
    }
    return;
  }
  is_told_ = false;
  if (holds_flown_plan(flight_.s, outcome, flight_.view.owner()))
    return plan.prove(begun_ns_, now.now_ns);
  plan.forget();
  out.emplace_back(note{progress::other_plan_found{}});
}

// What it has moved on to before counts as well: a word about another plan may come before that is adopted.
std::vector<std::uint16_t> plan_watch::never_near(std::uint16_t sequence, told how) const {
  const auto& plan = flight_.s.progress.plan;
  if (!plan || followed_ != plan->generation.number)
    return {};
  const auto& g = plan->generation;
  const auto& start = flight_.s.progress.start; // what comes in it counts from there on when it has ended
  const bool was_heard = start ? is_start_heard() : was_heard_at_start_;
  if (!g.is_armed && !was_heard)
    return {};
  const auto first = start && was_heard ? start->sequence : g.is_armed ? g.current : g.start_sequence;
  auto end = how == told::at ? int{sequence} : sequence + 1;
  if (const auto loop = progress::loop_between(plan->map, g.moved_to.value_or(g.current), sequence))
    end = loop->jump_sequence; // all up to the jump would be flown
  end = std::max({end, int{g.moved_to.value_or(0)}, g.complete_upto ? *g.complete_upto + 1 : 0});
  if (end <= first)
    return {};
  return track_.never_near(first, static_cast<std::uint16_t>(end - 1),
                           how == told::reached ? std::optional(sequence) : std::nullopt);
}

std::string plan_watch::missed_sentence(const std::string& item_id) const {
  auto nearest_m = std::numeric_limits<double>::infinity();
  if (const auto& plan = flight_.s.progress.plan) {
    const auto item = std::ranges::find(plan->map.items, item_id, &progress::mapped_item::item_id);
    for (std::uint32_t i = 0; item != plan->map.items.end() && i < item->sequence_count; ++i)
      if (const auto near = track_.nearest_m(static_cast<std::uint16_t>(item->first_sequence + i)))
        nearest_m = std::min(nearest_m, *near);
  }
  return "item '" + item_id +
         "' is reported as skipped: the vehicle has passed it in its plan and was never nearer than " +
         (std::isfinite(nearest_m) ? std::to_string(std::lround(nearest_m)) + " m" : std::string("its margin")) +
         " to it; somebody else may have changed its plan or its current item";
}

} // namespace godwit::executor
