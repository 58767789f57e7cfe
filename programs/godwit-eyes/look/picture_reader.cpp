#include "programs/godwit-eyes/look/picture_reader.hpp"

#include <chrono>

namespace godwit::eyes {

namespace {

constexpr std::chrono::milliseconds look_period{50}; // shorter than a source rests between two tries

} // namespace

picture_reader::picture_reader(const io::video::camera_uri& from)
    : source_(
          from, {},
          [this] {
            {
              const std::lock_guard guard(mutex_);
              has_come_ = true;
            }
            changed_.notify_all();
          },
          from.kind != io::video::camera_kind::file) {}

std::optional<io::video::frame> picture_reader::next() {
  using io::video::source_state;
  for (;;) {
    const auto now = source_.report(); // first: what had come by then is taken below
    if (auto picture = source_.take())
      return picture;
    if (now.state == source_state::ended)
      return std::nullopt;
    if (now.state == source_state::failed || (now.state == source_state::opening && !now.reason.empty())) {
      problem_ = now.reason;
      return std::nullopt;
    }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, look_period, [this] { return has_come_; });
    has_come_ = false;
  }
}

} // namespace godwit::eyes
