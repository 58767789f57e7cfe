#include "programs/godwitd/sightings/sighting_flow.hpp"

#include <utility>

namespace godwit::daemon {

using mapobjects_store::map_failure;

void sighting_flow::begin() {
  is_flowing_ = feed_ != nullptr;
  is_over_told_ = false;
  go_on();
}

void sighting_flow::look_again() {
  is_resting_ = false;
  go_on();
}

void sighting_flow::go_on() {
  if (!is_flowing_)
    return;
  while (!is_resting_ && under_way_ < max_under_way) {
    const auto each = feed_->take();
    if (!each)
      break;
    record(*each);
  }
  if (feed_->is_over() && !std::exchange(is_over_told_, true))
    ways_.over();
}

void sighting_flow::record(const sighting_feed::numbered& each) {
  ++under_way_;
  ways_.ask_store(
      each.seen,
      [this, number = each.number](const mapobjects_store::sighting_answer& answer) {
        --under_way_;
        take(number, answer);
        go_on();
      },
      [this, number = each.number] {
        --under_way_;
        feed_->take_back(number);
        is_resting_ = true;
      });
}

void sighting_flow::take(std::uint64_t number, const mapobjects_store::sighting_answer& answer) {
  switch (answer.failure) {
  case map_failure::none:
    if (answer.seen && ways_.offer)
      offer(number, *answer.seen, 1);
    else
      feed_->resolve(number, true);
    return;
  case map_failure::busy:
    feed_->take_back(number);
    is_resting_ = true;
    return;
  case map_failure::broken:
    is_flowing_ = false;
    ways_.broken(answer.error);
    return;
  default:
    feed_->resolve(number, false);
    if (feed_->counts().refused <= max_told_refusals)
      ways_.complain("a sighting is refused: " + answer.error);
  }
}

// The map has it; until it was offered it counts as under way.
void sighting_flow::offer(std::uint64_t number, const mapobjects_store::observed& seen, int tries) {
  ++under_way_;
  ways_.offer(seen, [this, number, seen, tries](offer_outcome how) {
    --under_way_;
    if (how == offer_outcome::unknown && tries < max_offers)
      return offer(number, seen, tries + 1);
    if (how == offer_outcome::unknown)
      feed_->count_not_offered();
    feed_->resolve(number, true);
    go_on();
  });
}

} // namespace godwit::daemon
