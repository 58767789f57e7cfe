#include "programs/godwit-drill/flight_simulation/simulated_broker.hpp"

namespace godwit::drill {

using fleet_link::broker_failure;
using fleet_link::publication;

void simulated_broker::open(std::uint64_t attempt, const publication& will) {
  lose();
  attempt_ = attempt;
  will_ = will;
  next_ns_ = 0;
}

void simulated_broker::close(std::uint64_t upto) {
  if (attempt_ && *attempt_ <= upto)
    lose();
}

void simulated_broker::publish(std::uint64_t attempt, const publication& what) {
  if (attempt_ == attempt && is_open_)
    on_the_way_.push_back({0, what});
}

void simulated_broker::lose() {
  if (is_open_)
    world_.kept[will_.topic] = *will_.payload;
  attempt_.reset();
  is_open_ = false;
  on_the_way_.clear();
  next_ns_ = never_ns;
}

std::vector<simulated_broker::news> simulated_broker::on_time(std::int64_t now_ns) {
  std::vector<news> result;
  if (!attempt_ || now_ns < next_ns_)
    return result;
  next_ns_ = now_ns + look_ns;
  if (world_.is_away) {
    const auto attempt = *attempt_;
    const bool was_open = is_open_;
    lose();
    result.emplace_back(fleet_link::broker_closed{
        attempt, was_open ? broker_failure::lost : broker_failure::unreachable, "nobody answers"});
  } else if (!is_open_) {
    answer_try(result, now_ns);
  } else {
    take(result, now_ns);
  }
  return result;
}

void simulated_broker::answer_try(std::vector<news>& to, std::int64_t now_ns) {
  if (world_.is_deaf)
    return;
  const auto attempt = *attempt_;
  if (world_.refuses) {
    lose();
    to.emplace_back(fleet_link::broker_closed{attempt, broker_failure::not_authorised, "Not authorized"});
    return;
  }
  is_open_ = true;
  ++world_.connects;
  world_.connected_ns = now_ns;
  to.emplace_back(fleet_link::broker_opened{attempt});
}

void simulated_broker::take(std::vector<news>& to, std::int64_t now_ns) {
  if (world_.is_deaf)
    return;
  for (auto& each : on_the_way_)
    each.due_ns = each.due_ns == 0 ? now_ns + world_.takes_ns : each.due_ns;
  for (; !on_the_way_.empty() && on_the_way_.front().due_ns <= now_ns; on_the_way_.pop_front()) {
    const auto& what = on_the_way_.front().what;
    switch (what.how) {
    case publication::kind::event:
      world_.events.push_back(*what.payload);
      to.emplace_back(fleet_link::event_taken{*attempt_, what.number});
      break;
    case publication::kind::status:
      world_.kept[what.topic] = *what.payload;
      break;
    case publication::kind::kept:
      world_.kept[what.topic] = *what.payload;
      to.emplace_back(fleet_link::text_left{*attempt_});
      break;
    case publication::kind::live:
      ++world_.live;
      to.emplace_back(fleet_link::text_left{*attempt_});
      break;
    }
  }
}

} // namespace godwit::drill
