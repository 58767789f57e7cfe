// A camera that is opened, watched and opened again: newest picture wins.
//
//   opening ──a picture──> playing ──nothing for silence_limit, an error, the end──> failed ──back-off──> opening
//      └──nothing for open_limit, an error──> failed          (the end of a file: ended, and it stays so)
//
// A thread of its own builds the pipeline of GStreamer, reads its bus and watches the pictures; pictures come in
// GStreamer's threads and are stamped there in monotonic time. One waits for who takes it; a newer one takes its place,
// and the older is counted as dropped. A driver that does not come back from a call is seen by stuck_ns(): nothing of
// this process can end that, so the process has to. Errors: a sentence in the report, with the remedy.
// Thread: any; `on_frame` is called in GStreamer's threads and must not block.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "io/video/camera_uri.hpp"
#include "io/video/frame.hpp"

namespace godwit::io::video {

// Notices pictures that come and show nothing: black ones, and the same one again and again.
//
// A sample of 64 x 36 pixels decides. One second of it is a fault, so that a cut in a film or a hand before the lens is
// none; the first picture that is sound ends it. A real camera's noise never repeats. Thread: one at a time.
enum class picture_fault { none, black, repeated };

class picture_watch {
public:
  static constexpr std::int64_t patience_ns = 1'000'000'000;
  static constexpr std::uint32_t black_below = 24; // mean brightness; video black is 16
  static constexpr std::uint8_t light_from = 64;   // a pixel of that is a lamp: it is night, and the lens is open

  [[nodiscard]] picture_fault look(const frame& picture);

private:
  static constexpr std::size_t columns = 64;
  static constexpr std::size_t rows = 36;
  using sample = std::array<std::uint8_t, columns * rows>;

  sample last_{};
  bool has_last_ = false;
  std::int64_t sound_ns_ = 0;   // of the newest picture that was not black; 0: none yet
  std::int64_t changed_ns_ = 0; // of the newest that was another one than before
};

struct source_limits {
  std::chrono::milliseconds open_limit{6'000};    // RTSP asks three times and waits for a key frame
  std::chrono::milliseconds silence_limit{1'200}; // cameras have 5 to 60 pictures a second
  std::chrono::milliseconds first_wait{200};      // before it is opened again; doubles
  std::chrono::milliseconds longest_wait{700};    // so that it is back within 2 s of the camera
};

enum class source_state { opening, playing, failed, ended };

struct source_report {
  source_state state = source_state::opening;
  std::string reason; // why it does not play: a sentence for people; stays while it is opened again
  picture_fault fault = picture_fault::none;
  std::int32_t width = 0;
  std::int32_t height = 0;
  double frames_per_s = 0;
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;
  std::uint64_t opened = 0;
  std::uint64_t changes = 0; // of the size
};

class source {
public:
  // PACED: a file at the pace in which it was made; else as fast as frames are taken, and none is dropped.
  source(camera_uri from, source_limits limits, std::function<void()> on_frame, bool is_paced = true);
  ~source();
  source(const source&) = delete;
  source& operator=(const source&) = delete;

  // The newest that nobody has taken.
  [[nodiscard]] std::optional<frame> take();
  [[nodiscard]] source_report report() const;
  // For how long a call into GStreamer has not returned.
  [[nodiscard]] std::int64_t stuck_ns() const;

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::io::video
