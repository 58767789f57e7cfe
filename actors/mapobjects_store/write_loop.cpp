#include "actors/mapobjects_store/write_loop.hpp"

#include <algorithm>
#include <utility>

namespace godwit::mapobjects_store {

namespace {

using std::chrono::steady_clock;

// A job gets a turn in this time even while changes never cease, so that it ends at all.
constexpr std::chrono::milliseconds job_patience{100};

// Deliveries make garbage slowly; a load makes it at once.
constexpr std::uint64_t changes_between_cleanings = 50'000;

map_error closed_error() { return {map_errc::closed, "the map was closed with this undone", {}}; }

// Only what comes from the disk can be better the next time.
bool is_of_the_disk(const map_result<void>& done) { return !done && done.error().code == map_errc::disk; }

} // namespace

write_loop::write_loop(const map_writer_options& options, std::unique_ptr<map_store> store, work_queue& queue)
    : options_(options), store_(std::move(store)), queue_(queue), retry_delay_(options_.retry_min) {}

void write_loop::run() {
  for (;;) {
    const bool closing = queue_.take(backlog_, next_turn());
    if (must_stop(closing))
      break;
    if (!failing_ || steady_clock::now() >= next_try_)
      work();
  }
  give_up_rest();
  store_.reset();
}

// When to look again even if nothing arrives; nothing = only then.
std::optional<write_loop::time_point> write_loop::next_turn() const {
  if (backlog_.empty() && jobs_.empty() && !garbage_ && !close_deadline_)
    return std::nullopt;
  if (!failing_)
    return time_point{};
  return close_deadline_ ? std::min(next_try_, *close_deadline_) : next_try_;
}

bool write_loop::must_stop(bool closing) {
  if (!closing)
    return false;
  const auto now = steady_clock::now();
  if (!close_deadline_) {
    close_deadline_ = now + options_.close_timeout;
    next_try_ = now;
    retry_delay_ = options_.retry_min;
  }
  return backlog_.empty() || now >= *close_deadline_; // jobs can be done again; closing does not wait for them
}

void write_loop::work() {
  start_jobs();
  if (!backlog_.empty())
    commit_group();
  look_for_garbage();
  const bool busy = !backlog_.empty() || queue_.has_arrivals();
  const bool job_waits_long = steady_clock::now() - last_turn_ > job_patience;
  const bool may_try = !failing_ || steady_clock::now() >= next_try_;
  if ((!jobs_.empty() || garbage_) && may_try && (!busy || job_waits_long))
    take_turn();
  if (!failing_)
    store_->look_after_log(busy);
}

// A job at the head of the queue: all that came before it is durable.
void write_loop::start_jobs() {
  while (!backlog_.empty()) {
    auto* job = std::get_if<queued_job>(&backlog_.front());
    if (job == nullptr)
      return;
    if (auto started = job->start(*store_))
      jobs_.push_back(std::move(started));
    backlog_.pop_front();
    queue_.finished(1);
  }
}

// The longest run of changes at the head of the backlog within the bound of a group.
std::size_t write_loop::group_size() const {
  std::size_t size = 0;
  while (size < backlog_.size() && size < options_.max_group && std::holds_alternative<queued_change>(backlog_[size]))
    ++size;
  return size;
}

void write_loop::commit_group() {
  const auto size = group_size();
  group_results_.assign(size, {});
  left_out_.assign(size, false);
  auto outcome = group_outcome::one_is_wrong;
  while (outcome == group_outcome::one_is_wrong) // at most once for each change
    outcome = try_group(size);
  if (outcome == group_outcome::committed)
    finish_group(size);
}

// A change that goes wrong half way would take those beside it down: the group is tried again without it.
write_loop::group_outcome write_loop::try_group(std::size_t size) {
  auto done = store_->begin();
  for (std::size_t i = 0; done && i < size; ++i) {
    if (left_out_[i])
      continue;
    group_results_[i] = store_->apply(std::get<queued_change>(backlog_[i]).work);
    if (!store_->is_spoilt())
      continue;
    done = group_results_[i];
    if (!is_of_the_disk(done)) {
      left_out_[i] = true;
      store_->roll_back();
      return group_outcome::one_is_wrong;
    }
  }
  if (done)
    done = store_->commit();
  if (done) {
    disk_works(size);
    return group_outcome::committed;
  }
  store_->roll_back();
  disk_failed(done.error());
  if (is_of_the_disk(done))
    return group_outcome::disk_error;
  group_results_.assign(size, done); // a damaged file: no later try is better, and all have to hear it
  return group_outcome::committed;
}

void write_loop::finish_group(std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    std::get<queued_change>(backlog_[i]).done(group_results_[i]);
  backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(size));
  queue_.finished(size);
}

void write_loop::take_turn() {
  last_turn_ = steady_clock::now();
  turn now([this] { return queue_.has_arrivals(); });
  bool finished = false;
  staged_work& job = jobs_.empty() ? static_cast<staged_work&>(*garbage_) : *jobs_.front();
  auto done = store_->begin(commit_of(job)).and_then([&] { return store_->apply(job, now); }).and_then([&](bool last) {
    finished = last;
    return store_->commit();
  });
  if (!done) {
    store_->roll_back();
    return is_of_the_disk(done) ? disk_failed(done.error()) : end_turn(done);
  }
  disk_works(0);
  job.committed();
  if (finished)
    end_turn({});
}

// Of the job that had the last turn.
void write_loop::end_turn(const map_result<void>& result) {
  if (jobs_.empty()) {
    garbage_.reset();
    return;
  }
  const auto job = std::move(jobs_.front());
  jobs_.pop_front();
  job->finish(result);
}

void write_loop::look_for_garbage() {
  const auto& map = store_->map();
  const auto loading = store_->load().generation;
  const bool load_given_up = clean_loading_ != 0 && clean_loading_ != loading;
  const bool due = clean_generation_ != map.generation || clean_mission_ != map.pulled_mission_id || load_given_up ||
                   changes_since_clean_ >= changes_between_cleanings;
  clean_loading_ = loading;
  if (!due)
    return;
  clean_generation_ = map.generation;
  clean_mission_ = map.pulled_mission_id;
  changes_since_clean_ = 0;
  garbage_ = std::make_unique<garbage_collection>(); // one that is half way begins anew
}

void write_loop::give_up_rest() {
  for (auto& item : backlog_) {
    if (auto* change = std::get_if<queued_change>(&item))
      change->done(tl::unexpected(closed_error()));
    else
      std::get<queued_job>(item).dropped(closed_error());
  }
  queue_.finished(backlog_.size());
  backlog_.clear();
  for (const auto& job : jobs_)
    job->finish(tl::unexpected(closed_error()));
  jobs_.clear();
}

void write_loop::disk_failed(const map_error& error) {
  next_try_ = steady_clock::now() + retry_delay_;
  retry_delay_ = std::min(retry_delay_ * 2, options_.retry_max);
  {
    std::lock_guard lock(status_mutex_);
    ++status_.retries;
    status_.failing = true;
    status_.reason = error.message();
  }
  if (!std::exchange(failing_, true) && options_.on_health_change)
    options_.on_health_change(status());
}

void write_loop::disk_works(std::size_t changes) {
  changes_since_clean_ += changes;
  retry_delay_ = options_.retry_min;
  {
    std::lock_guard lock(status_mutex_);
    ++status_.commits;
    status_.changes += changes;
    status_.failing = false;
    status_.reason.clear();
  }
  if (std::exchange(failing_, false) && options_.on_health_change)
    options_.on_health_change(status());
}

map_writer_status write_loop::status() const {
  std::lock_guard lock(status_mutex_);
  auto result = status_;
  result.queued = queue_.size();
  return result;
}

} // namespace godwit::mapobjects_store
