#include "programs/godwit-eyes/session/picture_maker.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "io/video/jpeg_encoder.hpp"

namespace godwit::eyes {

struct picture_maker::parts {
  io::eyes::picture_slot* slot = nullptr;
  std::unique_ptr<io::video::recorder> records;

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::optional<io::video::frame> waiting;
  std::int64_t wanted_until_ns = 0;
  std::int64_t gap_ns = 0;
  picture_report now;
  bool is_ending = false;
  std::thread thread;

  // Of the thread.
  std::int64_t shown_ns = 0;
  std::int64_t recorded_ns = 0;

  void run() {
    io::video::jpeg_encoder encoder(quality);
    for (std::unique_lock lock(mutex);;) {
      changed.wait(lock, [this] { return is_ending || waiting; });
      if (is_ending)
        return;
      const auto picture = *std::exchange(waiting, std::nullopt);
      const auto at = picture.captured_ns;
      const bool shows = slot != nullptr && at < wanted_until_ns && at - shown_ns >= gap_ns;
      const bool keeps = records && at - recorded_ns >= record_gap_ns;
      if (!shows && !keeps)
        continue;
      lock.unlock();
      make(encoder, picture, shows, keeps);
      lock.lock();
    }
  }

  void make(io::video::jpeg_encoder& encoder, const io::video::frame& picture, bool shows, bool keeps) {
    const auto jpeg = encoder.encode(picture);
    if (!jpeg)
      return;
    const bool is_shown = shows && slot->publish(*jpeg, picture.captured_ns, picture.width, picture.height);
    if (shows)
      shown_ns = picture.captured_ns;
    if (keeps) {
      recorded_ns = picture.captured_ns;
      records->add(*jpeg, picture.captured_ns, picture.width, picture.height);
    }
    const std::lock_guard guard(mutex);
    if (is_shown)
      ++now.shown;
    if (keeps) {
      now.recorded_bytes = records->report().bytes;
      now.record_error = records->report().error;
    }
  }
};

picture_maker::picture_maker(io::eyes::picture_slot* slot, std::optional<io::video::recorder_settings> records)
    : parts_(std::make_unique<parts>()) {
  parts_->slot = slot;
  if (records)
    parts_->records = std::make_unique<io::video::recorder>(*std::move(records));
  parts_->thread = std::thread([all = parts_.get()] { all->run(); });
}

picture_maker::~picture_maker() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_ending = true;
  }
  parts_->changed.notify_all();
  parts_->thread.join();
}

void picture_maker::want(std::int64_t until_ns, std::int64_t gap_ns) {
  const std::lock_guard guard(parts_->mutex);
  parts_->wanted_until_ns = until_ns;
  parts_->gap_ns = gap_ns;
}

void picture_maker::offer(const io::video::frame& picture) {
  {
    const std::lock_guard guard(parts_->mutex);
    const bool is_wanted = parts_->records || picture.captured_ns < parts_->wanted_until_ns;
    if (!is_wanted)
      return;
    parts_->waiting = picture;
  }
  parts_->changed.notify_all();
}

picture_report picture_maker::report() const {
  const std::lock_guard guard(parts_->mutex);
  return parts_->now;
}

} // namespace godwit::eyes
