#include "actors/mapobjects_store/map_access.hpp"

#include <utility>

namespace godwit::mapobjects_store {

map_result<void> map_access::add_page(load_page page, const page_stage::callback& done) {
  auto shared = std::make_shared<load_page>(std::move(page));
  return push(queued_job{.start = [shared, done](map_store&) -> std::unique_ptr<staged_work> {
                           return std::make_unique<page_stage>(std::move(*shared), done);
                         },
                         .dropped = [done](const map_error& error) { done(tl::unexpected(error)); }});
}

map_result<void> map_access::finish(const finish_load& asked, const load_finish::callback& done) {
  return push(queued_job{.start = [asked, done](map_store&) -> std::unique_ptr<staged_work> {
                           return std::make_unique<load_finish>(asked, done);
                         },
                         .dropped = [done](const map_error& error) { done(tl::unexpected(error)); }});
}

map_result<void> map_access::review(pass_end pass, const pass_review::callback& done) {
  const auto start = [pass = std::move(pass), done](map_store& store) -> std::unique_ptr<staged_work> {
    auto made = store.review(pass, done);
    if (made)
      return std::move(*made);
    done(tl::unexpected(std::move(made.error())));
    return nullptr;
  };
  return push(queued_job{.start = start, .dropped = [done](const map_error& error) { done(tl::unexpected(error)); }});
}

namespace {

using io::sqlite::store_errc;
using io::sqlite::store_error;
using io::sqlite::store_result;

// Deliveries make garbage slowly; a load makes it at once.
constexpr std::uint64_t changes_between_cleanings = 50'000;

map_error closed_error() { return {map_errc::closed, "the map was closed with this undone", {}}; }

// Only what comes from the disk can be better the next time.
bool is_of_the_disk(const map_result<void>& done) { return !done && done.error().code == map_errc::disk; }

// For the writer, which asks only whether it may pass; the map's own words are kept beside it.
store_error for_writer(const map_error& error) {
  const auto code = error.code == map_errc::disk      ? store_errc::io
                    : error.code == map_errc::corrupt ? store_errc::corrupt
                    : error.code == map_errc::foreign ? store_errc::foreign
                                                      : store_errc::misuse;
  return {code, {}, error.what, error.remedy};
}

store_result<void> for_writer(const map_result<void>& done) {
  return done.map_error([](const map_error& error) { return for_writer(error); });
}

} // namespace

bool map_target::is_write(const map_item& item) const { return std::holds_alternative<queued_change>(item.work); }

store_result<void> map_target::begin() { return for_writer(store_->begin()); }

store_result<void> map_target::apply(map_item& item) {
  item.said = store_->apply(std::get<queued_change>(item.work).work);
  return store_->is_spoilt() ? for_writer(item.said) : store_result<void>();
}

store_result<void> map_target::commit() { return for_writer(store_->commit()); }

void map_target::finish(map_item& item, const store_result<void>& result) {
  ++changes_since_clean_;
  if (item.said && !result) // not its own fault
    item.said = tl::unexpected(from_store(result.error()));
  std::get<queued_change>(item.work).done(item.said);
}

void map_target::run(map_item& job) {
  if (auto started = std::get<queued_job>(job.work).start(*store_))
    jobs_.push_back(std::move(started));
}

void map_target::give_up(map_item& item, const std::optional<store_error>&) {
  if (auto* change = std::get_if<queued_change>(&item.work))
    change->done(tl::unexpected(closed_error()));
  else
    std::get<queued_job>(item.work).dropped(closed_error());
}

bool map_target::has_turn() {
  look_for_garbage();
  return !jobs_.empty() || garbage_ != nullptr;
}

store_result<bool> map_target::take_turn(const std::function<bool()>& urgent) {
  decision_context now(urgent, clock_);
  bool finished = false;
  staged_work& job = jobs_.empty() ? static_cast<staged_work&>(*garbage_) : *jobs_.front();
  auto done = store_->begin(commit_of(job)).and_then([&] { return store_->apply(job, now); }).and_then([&](bool last) {
    finished = last;
    return store_->commit();
  });
  if (!done)
    store_->roll_back();
  if (is_of_the_disk(done))
    return tl::unexpected(for_writer(done.error()));
  if (done)
    job.committed();
  if (!done || finished)
    end_job(done);
  return done.has_value();
}

// Of the job that had the last turn.
void map_target::end_job(const map_result<void>& result) {
  if (jobs_.empty()) {
    garbage_.reset();
    return;
  }
  const auto job = std::move(jobs_.front());
  jobs_.pop_front();
  job->finish(result);
}

void map_target::look_for_garbage() {
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

void map_target::close() {
  for (const auto& job : jobs_)
    job->finish(tl::unexpected(closed_error()));
  jobs_.clear();
  store_.reset();
}

} // namespace godwit::mapobjects_store
