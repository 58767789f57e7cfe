#include "programs/godwit-trace/link_session.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "io/mavlink/frame.hpp"
#include "programs/common/heartbeat_sender.hpp"
#include "programs/common/link_advice.hpp"
#include "programs/common/peer_scanners.hpp"
#include "programs/godwit-trace/tlog_run.hpp"
#include "programs/godwit-trace/traffic.hpp"

namespace godwit::trace_tool {

namespace {

namespace mavlink = io::mavlink;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds second{1'000};          // between heartbeats, tables and flushes of the recording
constexpr milliseconds silence_of_stream{250}; // then no more bytes belong to the frame that waits for some
constexpr std::string_view clear_screen = "\x1b[H\x1b[2J";

std::int64_t wall_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::uint64_t wall_us() { return static_cast<std::uint64_t>(wall_ns() / 1'000); }

std::vector<skipped> passed_over(const mavlink::scan_counters& heard, std::uint64_t dropped_bytes,
                                 std::vector<skipped> refused) {
  std::vector<skipped> result{{"bad_checksums", "frames with a wrong checksum (CRC)", heard.bad_crc},
                              {"unknown_ids", "frames of ids that nobody knows", heard.unknown_id},
                              {"unknown_flags", "frames with flags that nobody knows", heard.unknown_flag},
                              {"v1_frames", "frames of MAVLink 1", heard.v1_frames},
                              {"cut_off", "frames that were cut off", heard.cut_off},
                              {"garbage_bytes", "bytes that belong to no frame", heard.garbage_bytes},
                              {"dropped_bytes", "bytes that came faster than they could be printed", dropped_bytes}};
  result.insert(result.end(), refused.begin(), refused.end());
  return result;
}

class link_session {
public:
  link_session(link_session_options options, console& to)
      : options_(std::move(options)), to_(to), printer_(options_.print.form),
        hints_(options_.where, options_.heartbeat_as.has_value()),
        check_(options_.keys ? std::optional(std::move(options_.keys->to_verify)) : std::nullopt) {
    if (options_.heartbeat_as)
      heartbeat_.emplace(*options_.heartbeat_as,
                         options_.keys ? std::optional(std::move(options_.keys->to_sign)) : std::nullopt);
  }

  [[nodiscard]] bool open() {
    if (!options_.tlog.empty())
      if (const auto opened = recording_.open(options_.tlog); !opened) {
        to_.say(opened.error());
        return false;
      }
    auto opened = io::link::open_link(options_.where, callbacks());
    if (!opened) {
      to_.say(opened.error());
      return false;
    }
    link_ = *std::move(opened);
    return true;
  }

  [[nodiscard]] exit_code run(int stop) {
    while (!is_over()) {
      const auto now = steady_clock::now();
      if (now >= next_second_)
        each_second(now);
      if (!wait(stop, now))
        stopped_ = true;
      hear();
    }
    return finish();
  }

private:
  io::link::link_callbacks callbacks() {
    io::link::link_callbacks result;
    result.received = [this](io::link::peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
      queue_.push({wall_us(), is_datagram, {bytes.begin(), bytes.end()}, std::nullopt, peer});
    };
    result.changed = [this](const io::link::link_status& status) { queue_.push({wall_us(), false, {}, status}); };
    return result;
  }

  [[nodiscard]] bool is_over() const { return stopped_ || !to_.out.is_taken() || is_count_reached() || is_time_over(); }
  [[nodiscard]] bool is_count_reached() const { return options_.count && printed_ >= *options_.count; }
  [[nodiscard]] bool is_time_over() const {
    return options_.seconds && steady_clock::now() - began_ >= *options_.seconds;
  }

  // False when it is time to stop. Returns at the latest when something is due.
  [[nodiscard]] bool wait(int stop, steady_clock::time_point now) const {
    auto until = next_second_;
    if (options_.seconds)
      until = std::min(until, began_ + *options_.seconds);
    if (scanner_.waiting_bytes() != 0)
      until = std::min(until, now + silence_of_stream);
    const auto left = std::chrono::ceil<milliseconds>(until - now);
    std::array<pollfd, 2> watched{pollfd{stop, POLLIN, 0}, pollfd{queue_.descriptor(), POLLIN, 0}};
    ::poll(watched.data(), watched.size(), static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    return watched[0].revents == 0;
  }

  void hear() {
    const auto chunks = queue_.take();
    const auto now = steady_clock::now();
    if (!chunks.empty())
      last_heard_ = now;
    else if (scanner_.waiting_bytes() != 0 && now - last_heard_ >= silence_of_stream)
      end_of_datagram(wall_us());
    for (const auto& each : chunks)
      take(each);
    if (!options_.print.stats)
      to_.out.flush(); // it is shown when it comes
  }

  void take(const heard_chunk& chunk) {
    if (chunk.status) {
      end_of_datagram(chunk.time_us);
      tell(*chunk.status);
      return;
    }
    const auto sink = [&](const mavlink::frame_view& frame) { take(frame, chunk.time_us); };
    scanner_.feed(chunk.peer, chunk.is_datagram, chunk.bytes, sink);
  }

  void end_of_datagram(std::uint64_t time_us) {
    scanner_.end_of_datagram([&](const mavlink::frame_view& frame) { take(frame, time_us); });
  }

  void take(const mavlink::frame_view& frame, std::uint64_t time_us) {
    const auto answer = check_.judge(frame, time_us);
    say_if_any(answer.sentence);
    if (!answer.is_accepted)
      return;
    say_if_any(recording_.write(time_us, frame));
    if (!options_.print.filter.wants(frame) || is_count_reached())
      return;
    heard_.note(time_us, frame);
    ++printed_;
    if (!options_.print.stats)
      printer_.append(to_.out.text(), time_us, frame);
  }

  void tell(const io::link::link_status& status) {
    to_.out.flush();
    to_.say(std::string(io::name_of(status.phase)) + ": " + status.reason);
  }

  void say_if_any(const std::string& sentence) {
    if (!sentence.empty())
      to_.say(sentence);
  }

  void each_second(steady_clock::time_point now) {
    next_second_ = now + second;
    if (heartbeat_)
      heartbeat_->send(*link_, wall_ns());
    say_if_any(recording_.flush());
    if (const auto hint = hints_.due(std::chrono::duration_cast<milliseconds>(now - began_), scanner_.counters()))
      to_.say(*hint);
    if (options_.print.stats && to_.is_terminal && options_.print.form == print_form::text) {
      to_.out.text() += clear_screen;
      append_table(to_.out.text(), report());
      to_.out.flush();
    }
  }

  [[nodiscard]] traffic_report report() const {
    traffic_report result{heard_, {}, passed_over(scanner_.counters(), queue_.dropped_bytes(), check_.refused())};
    for (const auto& each : scanner_.senders())
      if (options_.print.filter.wants_sender(each.who))
        result.senders.push_back(each);
    return result;
  }

  [[nodiscard]] exit_code finish() {
    link_.reset(); // nothing more comes; what came is shown
    hear();
    auto& into = options_.print.stats ? to_.out : to_.words;
    if (options_.print.stats && options_.print.form == print_form::json) {
      append_traffic_json(into.text(), report());
      into.text() += '\n';
    } else {
      if (options_.print.stats && to_.is_terminal)
        into.text() += clear_screen;
      append_table(into.text(), report());
    }
    into.flush();
    say_if_any(recording_.close());
    const bool heard_nothing = scanner_.counters().frames == 0 && is_time_over();
    if (heard_nothing)
      to_.say("not one MAVLink 2 frame was heard");
    return heard_nothing || recording_.has_lost() ? exit_code::failed : exit_code::ok;
  }

  link_session_options options_;
  console& to_;
  message_printer printer_;
  link_hints hints_;
  signature_check check_;
  std::optional<programs::heartbeat_sender> heartbeat_;
  tlog_recording recording_;
  programs::peer_scanners scanner_;
  traffic heard_;
  std::uint64_t printed_ = 0;
  bool stopped_ = false;
  const steady_clock::time_point began_ = steady_clock::now();
  steady_clock::time_point next_second_ = began_;
  steady_clock::time_point last_heard_ = began_;
  chunk_queue queue_;
  std::unique_ptr<io::link::link> link_; // last: its thread uses the queue
};

} // namespace

exit_code run_link(link_session_options options, console& to, int stop) {
  link_session session(std::move(options), to);
  return session.open() ? session.run(stop) : exit_code::failed;
}

std::optional<std::string> link_hints::due(std::chrono::milliseconds elapsed, const io::mavlink::scan_counters& heard) {
  if (heard.frames != 0)
    return std::nullopt;
  if (!told_v1_ && elapsed >= v1_after && heard.v1_frames >= v1_frames_enough) {
    told_v1_ = true;
    told_silence_ = true;
    return std::string("only MAVLink 1 is heard, which is not shown. ") + programs::advice_for_mavlink_1;
  }
  if (told_silence_ || elapsed < silent_after || heard.v1_frames != 0)
    return std::nullopt;
  told_silence_ = true;
  return heard.bytes == 0 ? programs::advice_for_silence(where_, silent_after, has_heartbeat_)
                          : programs::advice_for_noise(where_, heard.bytes);
}

chunk_queue::chunk_queue() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(), "eventfd");
}

chunk_queue::~chunk_queue() { ::close(descriptor_); }

void chunk_queue::push(heard_chunk chunk) {
  {
    const std::lock_guard guard(mutex_);
    // A change of the status is always told: there are few, and each says what the next bytes mean.
    const bool has_room =
        waiting_bytes_ + chunk.bytes.size() <= max_waiting_bytes && waiting_.size() < max_waiting_chunks;
    if (!has_room && !chunk.status) {
      dropped_bytes_ += chunk.bytes.size();
      return;
    }
    waiting_bytes_ += chunk.bytes.size();
    waiting_.push_back(std::move(chunk));
  }
  const std::uint64_t one = 1;
  static_cast<void>(!::write(descriptor_, &one, sizeof one)); // fails only when the descriptor is readable already
}

std::vector<heard_chunk> chunk_queue::take() {
  std::uint64_t ignored = 0;
  static_cast<void>(!::read(descriptor_, &ignored, sizeof ignored)); // fails only when nothing was pushed
  const std::lock_guard guard(mutex_);
  waiting_bytes_ = 0;
  return std::exchange(waiting_, {});
}

std::uint64_t chunk_queue::dropped_bytes() const {
  const std::lock_guard guard(mutex_);
  return dropped_bytes_;
}

} // namespace godwit::trace_tool
