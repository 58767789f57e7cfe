#include "io/video/source.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "io/video/frame.hpp"
#include "io/video/pipeline.hpp"

namespace godwit::io::video {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds look_period{50};
constexpr std::int64_t rate_window_ns = 1'000'000'000;
constexpr std::size_t max_in_window = 256;

std::int64_t ns(milliseconds time) { return std::chrono::nanoseconds(time).count(); }

std::string seconds(milliseconds time) {
  auto text = std::to_string(time.count() / 1000) + "." + std::to_string(time.count() % 1000 / 100);
  return text + " s";
}

} // namespace

struct source::parts {
  parts(camera_uri where, source_limits bounds, std::function<void()> tell, bool paced)
      : from(std::move(where)), limits(bounds), on_frame(std::move(tell)), is_paced(paced) {}

  void run();
  // What became of one opening.
  source_state play_once();
  source_state watch(pipeline& playing);
  void take_in(frame picture);
  void fail(std::string why, source_state state = source_state::failed);
  bool rest(milliseconds time); // false: it is to end

  const camera_uri from;
  const source_limits limits;
  const std::function<void()> on_frame;
  const bool is_paced;

  std::atomic<std::int64_t> calling_since_ns{0}; // into GStreamer; 0: not
  mutable std::mutex mutex;
  std::condition_variable changed; // it is to end, or a frame was taken
  source_report now;
  picture_watch watcher;
  std::optional<frame> newest;
  std::int64_t newest_ns = 0; // when the last one came; 0: none since it was opened
  std::deque<std::int64_t> in_window;
  bool is_ending = false;
  bool lets_go = false; // the pipeline is being taken down: nobody waits in it
  std::thread thread;
};

void source::parts::run() {
  auto wait = limits.first_wait;
  for (;;) {
    const auto how = play_once();
    const bool has_played = [this] {
      const std::lock_guard guard(mutex);
      return newest_ns != 0;
    }();
    if (how == source_state::ended)
      return;
    wait = has_played ? limits.first_wait : std::min(limits.longest_wait, wait * 2);
    if (!rest(wait))
      return;
  }
}

source_state source::parts::play_once() {
  {
    const std::lock_guard guard(mutex);
    now.state = source_state::opening;
    ++now.opened;
    newest_ns = 0;
    lets_go = false;
    in_window.clear();
  }
  calling_since_ns = monotonic_ns();
  auto made = pipeline::make(from, is_paced, [this](frame picture) { take_in(std::move(picture)); });
  if (!made) {
    calling_since_ns = 0;
    fail(std::move(made.error()));
    return source_state::failed;
  }
  auto playing = *std::move(made);
  const auto begun = playing->play();
  calling_since_ns = 0;
  auto result = source_state::failed;
  if (begun)
    result = watch(*playing);
  else
    fail(begun.error());
  calling_since_ns = monotonic_ns();
  {
    const std::lock_guard guard(mutex);
    lets_go = true;
  }
  changed.notify_all();
  playing.reset();
  calling_since_ns = 0;
  return result;
}

source_state source::parts::watch(pipeline& playing) {
  const auto opened_ns = monotonic_ns();
  for (;;) {
    if (const auto said = playing.wait(look_period)) {
      if (said->has_ended && from.kind == camera_kind::file) {
        fail("the recording is over", source_state::ended);
        return source_state::ended;
      }
      fail(said->has_ended ? "the camera has ended its pictures; it is opened again" : said->error);
      return source_state::failed;
    }
    std::unique_lock lock(mutex);
    if (is_ending)
      return source_state::ended;
    const auto at = monotonic_ns();
    const bool is_silent =
        newest_ns == 0 ? at - opened_ns > ns(limits.open_limit) : is_paced && at - newest_ns > ns(limits.silence_limit);
    if (!is_silent)
      continue;
    const bool never = newest_ns == 0;
    lock.unlock();
    fail(never ? "the camera is there and sends no picture for " + seconds(limits.open_limit) +
                     ": check its power, its cable and its settings"
               : "the camera has stopped to send pictures (none for " + seconds(limits.silence_limit) +
                     "); it is opened again");
    return source_state::failed;
  }
}

void source::parts::take_in(frame picture) {
  {
    std::unique_lock lock(mutex);
    if (!is_paced)
      changed.wait(lock, [this] { return !newest || is_ending || lets_go; });
    if (is_ending || lets_go)
      return;
    picture.captured_ns = std::max(picture.captured_ns, newest_ns + 1);
    newest_ns = picture.captured_ns;
    if (now.width != 0 && (now.width != picture.width || now.height != picture.height))
      ++now.changes;
    now.width = picture.width;
    now.height = picture.height;
    now.fault = watcher.look(picture);
    now.state = source_state::playing;
    now.reason.clear();
    ++now.frames;
    if (newest)
      ++now.dropped;
    newest = std::move(picture);
    in_window.push_back(newest_ns);
    if (in_window.size() > max_in_window)
      in_window.pop_front();
  }
  on_frame();
}

void source::parts::fail(std::string why, source_state state) {
  const std::lock_guard guard(mutex);
  now.state = state;
  now.reason = std::move(why);
  now.fault = picture_fault::none;
  watcher = {};
}

bool source::parts::rest(milliseconds time) {
  std::unique_lock lock(mutex);
  return !changed.wait_for(lock, time, [this] { return is_ending; });
}

source::source(camera_uri from, source_limits limits, std::function<void()> on_frame, bool is_paced)
    : parts_(std::make_unique<parts>(std::move(from), limits, std::move(on_frame), is_paced)) {
  parts_->thread = std::thread([all = parts_.get()] { all->run(); });
}

source::~source() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_ending = true;
  }
  parts_->changed.notify_all();
  parts_->thread.join();
}

std::optional<frame> source::take() {
  std::optional<frame> result;
  {
    const std::lock_guard guard(parts_->mutex);
    result = std::exchange(parts_->newest, std::nullopt);
  }
  parts_->changed.notify_all();
  return result;
}

source_report source::report() const {
  const std::lock_guard guard(parts_->mutex);
  auto result = parts_->now;
  const auto since = monotonic_ns() - rate_window_ns;
  result.frames_per_s = static_cast<double>(
      std::ranges::count_if(parts_->in_window, [since](std::int64_t each) { return each >= since; }));
  return result;
}

std::int64_t source::stuck_ns() const {
  const auto since = parts_->calling_since_ns.load();
  return since == 0 ? 0 : monotonic_ns() - since;
}

picture_fault picture_watch::look(const frame& picture) {
  sample now{};
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const auto y = row * static_cast<std::size_t>(picture.height) / rows;
      const auto x = column * static_cast<std::size_t>(picture.width) / columns;
      now.at(row * columns + column) = picture.planes[0].pixels[y * picture.planes[0].stride + x];
    }
  const auto mean = std::accumulate(now.begin(), now.end(), std::uint32_t{0}) / static_cast<std::uint32_t>(now.size());
  const auto at = picture.captured_ns;
  if (!has_last_ || mean >= black_below || std::ranges::max(now) >= light_from)
    sound_ns_ = at;
  if (!has_last_ || now != last_)
    changed_ns_ = at;
  has_last_ = true;
  last_ = now;
  if (at - sound_ns_ >= patience_ns)
    return picture_fault::black;
  return at - changed_ns_ >= patience_ns ? picture_fault::repeated : picture_fault::none;
}

} // namespace godwit::io::video
