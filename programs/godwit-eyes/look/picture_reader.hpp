// The pictures of a recording one by one, or those of a camera as they come. Errors: a sentence. Thread: one.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

#include "io/video/source.hpp"

namespace godwit::eyes {

class picture_reader {
public:
  explicit picture_reader(const io::video::camera_uri& from);

  // Waits for it. Nothing: it is over, or it failed.
  [[nodiscard]] std::optional<io::video::frame> next();
  // Why it failed; empty: it has not.
  [[nodiscard]] const std::string& problem() const { return problem_; }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_come_ = false;
  std::string problem_;
  io::video::source source_; // last: it calls from its beginning on
};

} // namespace godwit::eyes
