#include "runtime/journal/write_queue.hpp"

#include <iterator>
#include <thread>

namespace godwit::runtime {

namespace {

// How long the idle writer looks for work before it sleeps. Waking a sleeping thread costs about 50 us, a third of a
// commit; under load the next write comes within this time, and an idle system sleeps.
constexpr std::chrono::microseconds spin_before_sleep{30};

// Memory of a record beside its texts, roughly; only the order of magnitude matters for the bound.
constexpr std::size_t record_overhead_bytes = 128;

std::size_t bytes_of(const row_change& change) {
  std::size_t bytes = record_overhead_bytes + change.sql.size();
  for (const auto& value : change.values)
    bytes += sizeof(value) + (std::holds_alternative<std::string>(value) ? std::get<std::string>(value).size() : 0);
  return bytes;
}

std::size_t bytes_of(const journal_write& write) {
  std::size_t bytes = sizeof(write) + write.actor.size();
  if (write.event)
    bytes += write.event->type.size() + write.event->body.size();
  if (write.snapshot)
    bytes += write.snapshot->body.size();
  for (const auto& effect : write.effects)
    bytes += record_overhead_bytes + effect.type.size() + effect.body.size();
  for (const auto& mark : write.seen)
    bytes += record_overhead_bytes + mark.source.size();
  for (const auto& change : write.rows)
    bytes += bytes_of(change);
  for (const auto& row : write.outbox)
    bytes += record_overhead_bytes + row.idempotency_key.size() + row.destination.size() + row.body.size();
  for (const auto& letter : write.dead_letters)
    bytes += record_overhead_bytes + letter.body.size() + letter.reason.size();
  return bytes + write.released.size() * sizeof(effect_id);
}

} // namespace

tl::expected<void, journal_errc> write_queue::push(journal_write&& write) {
  const auto bytes = bytes_of(write);
  std::unique_lock lock(mutex_);
  if (closed_)
    return tl::unexpected(journal_errc::closed);
  const auto fence = first_valid_incarnation_.find(write.actor);
  if (fence != first_valid_incarnation_.end() && write.incarnation < fence->second) {
    ++refused_;
    return tl::unexpected(journal_errc::stale_incarnation);
  }
  if (writes_ >= limits_.max_writes || bytes_ + bytes > limits_.max_bytes) {
    ++refused_;
    return tl::unexpected(journal_errc::queue_full);
  }
  ++writes_;
  ++pushed_;
  bytes_ += bytes;
  arrivals_.emplace_back(queued_write{std::move(write), bytes, std::nullopt});
  wake(std::move(lock));
  return {};
}

bool write_queue::push(queued_recovery&& recovery, std::uint64_t incarnation) {
  std::unique_lock lock(mutex_);
  if (closed_)
    return false;
  auto& first_valid = first_valid_incarnation_[recovery.actor];
  first_valid = std::max(first_valid, incarnation);
  arrivals_.emplace_back(std::move(recovery));
  wake(std::move(lock));
  return true;
}

tl::expected<void, journal_errc> write_queue::push(bulk_load&& load) {
  std::unique_lock lock(mutex_);
  if (closed_)
    return tl::unexpected(journal_errc::closed);
  if (loads_ >= limits_.max_loads) {
    ++refused_;
    return tl::unexpected(journal_errc::queue_full);
  }
  ++loads_;
  load_arrivals_.push_back(std::move(load));
  wake(std::move(lock));
  return {};
}

void write_queue::close() {
  std::unique_lock lock(mutex_);
  closed_ = true;
  wake(std::move(lock));
}

void write_queue::wake(std::unique_lock<std::mutex> lock) {
  arrived_.store(true, std::memory_order_release);
  const bool sleeps = writer_sleeps_;
  lock.unlock();
  if (sleeps)
    wake_writer_.notify_one();
}

bool write_queue::take(std::deque<queue_item>& items, std::deque<bulk_load>& loads, std::optional<time_point> until) {
  const auto spin_end = std::chrono::steady_clock::now() + spin_before_sleep;
  while (!arrived_.load(std::memory_order_acquire) && std::chrono::steady_clock::now() < spin_end) {
    if (until && std::chrono::steady_clock::now() >= *until)
      break;
    std::this_thread::yield();
  }
  std::unique_lock lock(mutex_);
  const auto something = [&] { return arrived_.load(std::memory_order_relaxed); };
  writer_sleeps_ = true;
  if (until)
    wake_writer_.wait_until(lock, *until, something);
  else
    wake_writer_.wait(lock, something);
  writer_sleeps_ = false;
  arrived_.store(false, std::memory_order_relaxed);
  std::move(arrivals_.begin(), arrivals_.end(), std::back_inserter(items));
  std::move(load_arrivals_.begin(), load_arrivals_.end(), std::back_inserter(loads));
  arrivals_.clear();
  load_arrivals_.clear();
  return closed_;
}

void write_queue::finished(std::size_t writes, std::size_t bytes) {
  {
    std::lock_guard lock(mutex_);
    writes_ -= writes;
    bytes_ -= bytes;
    finished_ += writes;
  }
  progress_.notify_all();
}

void write_queue::load_finished() {
  std::lock_guard lock(mutex_);
  --loads_;
}

bool write_queue::wait_until_finished(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  const auto target = pushed_;
  return progress_.wait_for(lock, timeout, [&] { return finished_ >= target; });
}

std::uint64_t write_queue::refused() const {
  std::lock_guard lock(mutex_);
  return refused_;
}

std::uint64_t write_queue::queued() const {
  std::lock_guard lock(mutex_);
  return writes_;
}

} // namespace godwit::runtime
