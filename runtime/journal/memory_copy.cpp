#include "runtime/journal/memory_copy.hpp"

#include "runtime/journal/overlay.hpp"

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

} // namespace godwit::runtime
