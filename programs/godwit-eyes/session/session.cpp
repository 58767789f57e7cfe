#include "programs/godwit-eyes/session/session.hpp"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <memory>
#include <optional>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include "io/video/source.hpp"
#include "programs/godwit-eyes/session/looker.hpp"
#include "programs/godwit-eyes/session/picture_maker.hpp"

namespace godwit::eyes {
namespace {

using std::chrono::milliseconds;

std::int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

constexpr unsigned end_limit_s = 3; // to finish the recording and to let go of the camera

constexpr std::int64_t ns(milliseconds time) { return std::chrono::nanoseconds(time).count(); }

io::eyes::source_state state_of(io::video::source_state state) {
  switch (state) {
  case io::video::source_state::opening:
    return io::eyes::source_state::opening;
  case io::video::source_state::playing:
    return io::eyes::source_state::playing;
  case io::video::source_state::failed:
    return io::eyes::source_state::failed;
  case io::video::source_state::ended:
    break;
  }
  return io::eyes::source_state::ended;
}

io::eyes::picture_fault fault_of(io::video::picture_fault fault) {
  return fault == io::video::picture_fault::black      ? io::eyes::picture_fault::black
         : fault == io::video::picture_fault::repeated ? io::eyes::picture_fault::repeated
                                                       : io::eyes::picture_fault::none;
}

std::optional<io::video::recorder_settings> recording_of(const io::eyes::begin& wanted) {
  if (wanted.record_folder.empty())
    return std::nullopt;
  constexpr std::uint64_t bytes_in_mb = 1'000'000;
  return io::video::recorder_settings{wanted.record_folder,
                                      static_cast<std::uint64_t>(wanted.record_max_mb) * bytes_in_mb};
}

// All that works on the pictures of one camera. The looker asks the source, and the source wakes the looker: so the
// looker asks only when the source is there, and has ended when it goes.
class work {
public:
  work(const io::eyes::begin& wanted, looker::model model, io::video::camera_uri from, io::eyes::channel& to_daemon,
       io::eyes::picture_slot& slot)
      : pictures_(&slot, recording_of(wanted)), cutouts_(slot),
        looker_(
            wanted, std::move(model),
            [this] {
              auto* const from_camera = asked_.load();
              return from_camera == nullptr ? std::nullopt : from_camera->take();
            },
            [this](const io::video::frame& each) { pictures_.offer(each); },
            [this, &to_daemon](const io::eyes::candidates& seen, const io::video::frame& in) {
              cutouts_.add(seen, in); // first: who hears of a candidate may look for its picture
              static_cast<void>(to_daemon.send(seen));
            }),
        source_(std::make_unique<io::video::source>(std::move(from), io::video::source_limits{},
                                                    [this] { looker_.wake(); })) {
    asked_ = source_.get();
  }
  ~work() { looker_.end(); }
  work(const work&) = delete;
  work& operator=(const work&) = delete;

  void add(const io::eyes::pose& said) { looker_.add(said); }
  void want(const io::eyes::want_picture& said) { pictures_.want(said.until_ns, ns(milliseconds(said.gap_ms))); }
  [[nodiscard]] std::int64_t stuck_ns() const { return source_->stuck_ns(); }
  [[nodiscard]] bool is_playing() const { return source_->report().state == io::video::source_state::playing; }

  [[nodiscard]] io::eyes::status status() const {
    const auto camera = source_->report();
    const auto seen = looker_.report();
    const auto shown = pictures_.report();
    io::eyes::status result;
    result.at_ns = monotonic_ns();
    result.source = state_of(camera.state);
    result.reason = io::eyes::clipped(camera.reason);
    result.fault = fault_of(camera.fault);
    result.width_px = camera.width;
    result.height_px = camera.height;
    result.frames_per_s = camera.frames_per_s;
    result.frames = camera.frames;
    result.dropped = camera.dropped;
    result.opened = camera.opened;
    result.changes = camera.changes;
    result.looked = seen.looked;
    result.usable = seen.usable;
    result.usable_at_ns = seen.usable_at_ns;
    result.unusable = io::eyes::clipped(seen.unusable);
    result.look_ms = seen.look_ms;
    result.pictures = shown.shown;
    result.recorded_kb = shown.recorded_bytes / 1000;
    result.record_error = io::eyes::clipped(shown.record_error);
    result.model_error = io::eyes::clipped(seen.model_error);
    return result;
  }

private:
  std::atomic<io::video::source*> asked_{nullptr};
  picture_maker pictures_;
  cutout_maker cutouts_;
  looker looker_;
  std::unique_ptr<io::video::source> source_;
};

class session {
public:
  session(io::eyes::channel& to_daemon, io::eyes::picture_slot& slot, session_hooks hooks)
      : to_daemon_(to_daemon), slot_(slot), hooks_(std::move(hooks)) {}

  session_end run() {
    auto next_ns = monotonic_ns();
    for (;;) {
      const auto now = monotonic_ns();
      if (now >= next_ns) {
        say_status();
        if (hooks_.is_camera_replaced && work_ && !work_->is_playing() && hooks_.is_camera_replaced())
          return session_end::replaced;
        next_ns = now + ns(status_period);
      }
      if (work_ && work_->stuck_ns() > std::chrono::nanoseconds(stuck_limit).count()) {
        static_cast<void>(work_.release()); // its threads do not end
        return session_end::stuck;
      }
      pollfd socket{to_daemon_.number(), POLLIN, 0};
      static_cast<void>(::poll(&socket, 1, static_cast<int>(std::max<std::int64_t>(1, (next_ns - now) / 1'000'000))));
      if (const auto end = read_all()) {
        ::alarm(end_limit_s); // a driver that does not come back keeps no camera
        return *end;
      }
    }
  }

private:
  void say_status() {
    if (work_)
      static_cast<void>(to_daemon_.send(work_->status()));
    else if (refused_)
      static_cast<void>(to_daemon_.send(*refused_));
  }

  std::optional<session_end> read_all() {
    for (;;) {
      auto read = to_daemon_.receive();
      if (!read)
        return session_end::garbage;
      if (read->is_closed)
        return session_end::closed;
      if (!read->said)
        return std::nullopt;
      if (const auto* first = std::get_if<io::eyes::begin>(&*read->said))
        begin(*first);
      else if (const auto* pose = std::get_if<io::eyes::pose>(&*read->said); pose != nullptr && work_)
        work_->add(*pose);
      else if (const auto* want = std::get_if<io::eyes::want_picture>(&*read->said); want != nullptr && work_)
        work_->want(*want);
    }
  }

  void begin(const io::eyes::begin& wanted) {
    if (work_ || refused_)
      return;
    auto from = io::video::parse_camera_uri(wanted.uri);
    if (from) {
      looker::model model; // its bytes: the file is out of reach afterwards
      if (!wanted.model.empty())
        model = io::eyes::read_model(wanted.model);
      if (hooks_.before_work)
        hooks_.before_work(wanted, *from);
      work_ = std::make_unique<work>(wanted, std::move(model), *std::move(from), to_daemon_, slot_);
      return;
    }
    refused_.emplace();
    refused_->at_ns = monotonic_ns();
    refused_->source = io::eyes::source_state::failed;
    refused_->reason = io::eyes::clipped("camera.uri: " + from.error());
  }

  io::eyes::channel& to_daemon_;
  io::eyes::picture_slot& slot_;
  session_hooks hooks_;
  std::unique_ptr<work> work_;
  std::optional<io::eyes::status> refused_; // the address of the camera is none
};

} // namespace

session_end run_session(io::eyes::channel& to_daemon, io::eyes::picture_slot& slot, session_hooks hooks) {
  return session(to_daemon, slot, std::move(hooks)).run();
}

} // namespace godwit::eyes
