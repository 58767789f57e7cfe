// Looks for movement in the newest picture, in a thread of its own, and says what it has found.
//
//   source ──newest frame──> looker ──candidates──> teller
//                               └──the same frame──> picture_maker
//
// The detector is made for the size of the pictures, and anew when that changes. Errors: what a picture can have wrong
// is a reason in the report. Thread: any; `tell` is called in the looker's.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "io/eyes/messages.hpp"
#include "io/eyes/model_files.hpp"
#include "io/video/frame.hpp"
#include "programs/godwit-eyes/ground/camera.hpp"

namespace godwit::eyes {

struct look_report {
  std::uint64_t looked = 0;
  std::uint64_t usable = 0;
  std::int64_t usable_at_ns = 0;
  std::string unusable; // why the newest picture says nothing; empty: it does
  double look_ms = 0;
  std::string model_error; // why it is not used; empty: there is none, or it is
};

class looker {
public:
  using teller = std::function<void(const io::eyes::candidates& seen, const io::video::frame& in)>;

  // MODEL: nothing where none is wanted; a sentence where it can not be read.
  // TAKE gives the newest frame that nobody has taken; PASS_ON is called with each frame that was looked at.
  using model = std::optional<tl::expected<io::eyes::model_files, std::string>>;
  looker(io::eyes::begin wanted, model asked, std::function<std::optional<io::video::frame>()> take,
         std::function<void(const io::video::frame&)> pass_on, teller tell);
  ~looker();
  looker(const looker&) = delete;
  looker& operator=(const looker&) = delete;

  void wake(); // there is a frame
  void end();  // looks at nothing more
  void add(const io::eyes::pose& said);
  [[nodiscard]] look_report report() const;

private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

// Where the camera was of late, so that a picture finds the pose of its own time. Thread: one at a time.
class pose_history {
public:
  static constexpr std::size_t max_poses = 128; // at 10 a second, twelve seconds
  static constexpr std::int64_t max_age_ns = 2'000'000'000;

  // One that is not newer than the last is left out.
  void add(const io::eyes::pose& said);
  // The nearest to that time; none is nearer than max_age_ns: nothing. How old it may be is for the detector to judge.
  [[nodiscard]] std::optional<camera_pose> at(std::int64_t time_ns) const;

private:
  std::deque<camera_pose> poses_; // oldest first
};

} // namespace godwit::eyes
