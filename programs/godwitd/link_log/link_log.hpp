// Writes what goes over the links to the vehicle and to ground stations into .tlog files beside the trace.
//
//   link threads, actors --tap--> one chunk_buffer a link --> writer thread --> vehicle-RUN-N.tlog, ground-RUN-N.tlog
//
// No link and no actor waits for it: what the writer is too slow for is dropped and counted. Drops, and a disk that
// refuses, turn its health (`link_log`) yellow with the counts, until nothing was lost for `quiet_ns`. Times of the
// frames are TIME's at the tap. Errors: open, a sentence. Thread: the taps from any; the rest by the owner.
#pragma once

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <tl/expected.hpp>

#include "io/link/wire.hpp"
#include "programs/godwitd/link_log/link_log_options.hpp"
#include "programs/godwitd/link_log/link_recording.hpp"
#include "runtime/clock.hpp"
#include "runtime/health_board.hpp"

namespace godwit::daemon {

enum class recorded_link : std::uint8_t { vehicle, ground };

class link_log {
public:
  static constexpr std::int64_t quiet_ns = 10'000'000'000;

  // RUN is a part of the names. TIME and HEALTH must live longer.
  [[nodiscard]] static tl::expected<std::unique_ptr<link_log>, std::string> open(const link_log_options& options,
                                                                                 std::uint64_t run,
                                                                                 const runtime::time_source& time,
                                                                                 runtime::health_board& health);
  link_log(const link_log&) = delete;
  link_log& operator=(const link_log&) = delete;
  ~link_log() { close(); }

  // May be called after the log is closed; then nothing is recorded.
  [[nodiscard]] std::shared_ptr<io::link::tap> tap(recorded_link which);

  // Writes what waits. TIME at the call counts.
  void drain();
  // Drains now and then in a thread of its own.
  void start();
  // Ends the thread and writes what waits.
  void close();

private:
  class link_tap;
  struct one_link {
    std::string name;
    std::shared_ptr<link_tap> tap;
    link_recording recording;
    std::uint64_t lost = 0; // at the last look: chunks dropped, frames not written
  };

  link_log(const link_log_options& options, const runtime::time_source& time, runtime::health_board& health);
  void run();
  void tell_health();

  const runtime::milliseconds flush_;
  const runtime::time_source& time_;
  runtime::health_board& health_;
  std::array<one_link, 2> links_;
  link_batch batch_;
  std::int64_t lost_at_ns_ = 0;
  std::string told_;

  std::mutex mutex_; // of what wakes the thread
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_; // last: it uses all of the above
};

} // namespace godwit::daemon
