#include "runtime/simulation/simulated_journal.hpp"

#include <algorithm>
#include <utility>

#include "runtime/assert.hpp"

namespace godwit::runtime {

namespace {

void apply_to_actor(const journal_write& write, recovered& kept) {
  for (const auto& event : write.events) {
    GODWIT_ASSERT(event.number == kept.last_event + 1, "event numbers of an actor rise by one");
    kept.last_event = event.number;
    kept.events.push_back(event);
  }
  if (write.snapshot) {
    kept.snapshot = write.snapshot;
    kept.last_event = std::max(kept.last_event, write.snapshot->number);
    std::erase_if(kept.events, [&](const event_record& each) { return each.number <= write.snapshot->number; });
  }
  kept.effects.insert(kept.effects.end(), write.effects.begin(), write.effects.end());
  for (const auto& id : write.released)
    std::erase_if(kept.effects, [&](const effect_record& each) { return each.id == id; });
  for (const auto& mark : write.seen) {
    const auto known = std::find_if(kept.seen.begin(), kept.seen.end(),
                                    [&](const seen_mark& each) { return each.source == mark.source; });
    if (known == kept.seen.end())
      kept.seen.push_back(mark);
    else
      known->upto = std::max(known->upto, mark.upto);
  }
}

} // namespace

void apply(const journal_write& write, simulated_disk& disk) {
  apply_to_actor(write, disk.actors[write.actor].kept);
  disk.rows.insert(disk.rows.end(), write.rows.begin(), write.rows.end());
  for (const auto& each : write.outbox)
    disk.outbox[each.idempotency_key] = each;
  disk.dead_letters.insert(disk.dead_letters.end(), write.dead_letters.begin(), write.dead_letters.end());
}

simulated_journal::simulated_journal(simulated_disk& disk) : disk_(disk) {
  ++disk_.runs;
  if (disk_.below)
    below_ = disk_.below();
}

tl::expected<void, journal_error> simulated_journal::submit(journal_write&& write) {
  if (below_ && !refusing_)
    return submit_below(std::move(write));
  if (write.incarnation < newest_incarnation_[write.actor]) {
    ++counted_.refused;
    return tl::unexpected(journal_error{journal_errc::stale_incarnation, "simulation",
                                        write.actor + " was replaced by a newer incarnation", "nothing to do"});
  }
  if (refusing_) {
    ++counted_.refused;
    return tl::unexpected(
        journal_error{journal_errc::queue_full, "simulation", "the writer is late by its bound", "stop refusing"});
  }
  if (is_broken(write))
    failed_.push_back(std::move(write));
  else
    queue_.emplace_back(std::move(write));
  return {};
}

void simulated_journal::recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) {
  if (below_)
    return recover_below(actor, incarnation, std::move(callback));
  auto& newest = newest_incarnation_[actor];
  newest = std::max(newest, incarnation);
  queue_.emplace_back(recovery{std::move(actor), std::move(callback)});
}

journal_status simulated_journal::status() const {
  if (below_) {
    auto below = below_->writer().status();
    below.run = disk_.runs;
    return below;
  }
  auto result = counted_;
  result.failing = failing_;
  result.reason = failing_ ? "the simulated disk fails" : "";
  result.queued = queue_.size();
  result.run = disk_.runs;
  return result;
}

void simulated_journal::tell_failed() {
  for (const auto& each : std::exchange(failed_, {}))
    if (each.done)
      each.done(tl::unexpected(broken_.at(each.actor)));
}

bool simulated_journal::step() {
  if (below_)
    return step_below();
  if (!failed_.empty()) {
    tell_failed();
    return true;
  }
  if (queue_.empty())
    return false;
  if (failing_)
    return recover_while_failing();
  if (holding_ && std::holds_alternative<journal_write>(queue_.front()))
    return false;
  if (std::holds_alternative<recovery>(queue_.front())) {
    auto asked = std::get<recovery>(std::move(queue_.front()));
    queue_.pop_front();
    answer(asked, {});
  } else {
    commit_group();
  }
  return true;
}

void simulated_journal::commit_group() {
  std::vector<journal_write> group;
  while (!queue_.empty() && std::holds_alternative<journal_write>(queue_.front())) {
    group.push_back(std::get<journal_write>(std::move(queue_.front())));
    queue_.pop_front();
  }
  const auto fails = [&](journal_write& each) {
    if (!breaks(each) && !is_broken(each))
      return false;
    failed_.push_back(std::move(each));
    return true;
  };
  std::erase_if(group, fails);
  for (const auto& each : group) {
    apply(each, disk_);
    ++counted_.writes;
    counted_.events += each.events.size();
  }
  ++counted_.commits;
  ++disk_.commits;
  for (const auto& each : group)
    if (each.done)
      each.done({});
  tell_failed();
}

bool simulated_journal::breaks(const journal_write& write) {
  if (write.events.empty() || broken_.contains(write.actor) || to_break_[write.actor] == 0)
    return false;
  --to_break_[write.actor];
  broken_.insert_or_assign(write.actor,
                           journal_error{journal_errc::io, "simulation", "this write can never commit", "none"});
  return true;
}

// With it fails what its actor writes until it recovers, but for what does not build on it.
bool simulated_journal::is_broken(const journal_write& write) const {
  const bool builds_on_earlier = !write.events.empty() || write.snapshot || !write.effects.empty();
  return builds_on_earlier && broken_.contains(write.actor);
}

bool simulated_journal::recover_while_failing() {
  const auto found = std::find_if(queue_.begin(), queue_.end(),
                                  [](const queued_item& each) { return std::holds_alternative<recovery>(each); });
  if (found == queue_.end())
    return false;
  std::deque<queued_item> ahead(queue_.begin(), found);
  auto asked = std::get<recovery>(std::move(*found));
  queue_.erase(found);
  answer(asked, ahead);
  return true;
}

void simulated_journal::answer(const recovery& asked, const std::deque<queued_item>& ahead) {
  broken_.erase(asked.actor);
  auto result = disk_.actors[asked.actor].kept;
  result.durable_upto = result.last_event;
  for (const auto& each : ahead)
    if (const auto* write = std::get_if<journal_write>(&each); write != nullptr && write->actor == asked.actor)
      apply_to_actor(*write, result);
  asked.callback(std::move(result));
}

// -- a file below -----------------------------------------------------------------------------------

tl::expected<void, journal_error> simulated_journal::submit_below(journal_write&& write) {
  const auto told = std::exchange(write.done, {});
  write.done = [this, told, kept = write](const commit_result& result) {
    if (is_gone_)
      return;
    ++called_back_;
    if (result)
      apply(kept, disk_);
    if (told)
      told(result);
  };
  auto taken = below_->writer().submit(std::move(write));
  if (!taken)
    write.done = told; // NOLINT(bugprone-use-after-move): what is refused stays as it was
  return taken;
}

void simulated_journal::recover_below(const std::string& actor, std::uint64_t incarnation,
                                      recovered_callback callback) {
  below_->writer().recover(actor, incarnation,
                           [this, actor, callback = std::move(callback)](tl::expected<recovered, journal_error> found) {
                             if (is_gone_)
                               return;
                             ++called_back_;
                             if (found)
                               look_at(actor, *found);
                             callback(std::move(found));
                           });
}

// A commit that failed for its process may be there all the same, when that one has ended before it tried again.
void simulated_journal::look_at(const std::string& actor, const recovered& found) {
  auto& kept = disk_.actors[actor].kept;
  if (found.last_event < kept.last_event)
    ++disk_.forgotten;
  if (found.last_event == found.durable_upto) // nothing waits beside it
    kept = found;
}

bool simulated_journal::step_below() {
  if (holding_)
    return false;
  const auto before = called_back_;
  below_->run_once();
  const auto commits = below_->writer().status().commits;
  disk_.commits += commits - std::exchange(counted_.commits, commits);
  return called_back_ != before;
}

} // namespace godwit::runtime
