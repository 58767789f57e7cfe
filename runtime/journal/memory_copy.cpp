#include "runtime/journal/memory_copy.hpp"

#include <algorithm>

namespace godwit::runtime {

void memory_copy::note(const journal_write& write) { lay_over(actors_[write.actor], write); }

recovered memory_copy::of(const std::string& actor) const {
  const auto found = actors_.find(actor);
  auto result = found == actors_.end() ? recovered{} : found->second;
  result.durable_upto = result.last_event;
  return result;
}

io::sqlite::result<void> memory_copy::write_to(record_store& store) const {
  for (const auto& [actor, state] : actors_) {
    journal_write covered; // first, because the numbers of the events go on from the snapshot's
    covered.actor = actor;
    covered.snapshot = state.snapshot;
    covered.effects = state.effects;
    covered.seen = state.seen;
    journal_write rest;
    rest.actor = actor;
    rest.events = state.events;
    if (auto done = store.apply(covered).and_then([&] { return store.apply(rest); }); !done)
      return done;
  }
  return {};
}

namespace {

void lay_effects(std::vector<effect_record>& effects, const journal_write& write) {
  effects.insert(effects.end(), write.effects.begin(), write.effects.end());
  const auto gone = [&](const effect_record& effect) {
    return std::find(write.released.begin(), write.released.end(), effect.id) != write.released.end();
  };
  effects.erase(std::remove_if(effects.begin(), effects.end(), gone), effects.end());
  std::sort(effects.begin(), effects.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
}

void lay_mark(std::vector<seen_mark>& marks, const seen_mark& mark) {
  const auto place = std::lower_bound(marks.begin(), marks.end(), mark,
                                      [](const auto& a, const auto& b) { return a.source < b.source; });
  if (place == marks.end() || place->source != mark.source)
    marks.insert(place, mark);
  else
    place->upto = std::max(place->upto, mark.upto);
}

} // namespace

void lay_over(recovered& base, const journal_write& write) {
  for (const auto& event : write.events) {
    base.events.push_back(event);
    base.last_event = event.number;
  }
  if (write.snapshot) {
    base.snapshot = write.snapshot;
    base.last_event = std::max(base.last_event, write.snapshot->number);
    const auto covered = [&](const event_record& event) { return event.number <= write.snapshot->number; };
    base.events.erase(std::remove_if(base.events.begin(), base.events.end(), covered), base.events.end());
  }
  lay_effects(base.effects, write);
  for (const auto& mark : write.seen)
    lay_mark(base.seen, mark);
}

} // namespace godwit::runtime
