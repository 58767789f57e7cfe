// The command `probe`: opens a camera as godwitd would, and says what comes of it, or why nothing does.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "io/video/source.hpp"
#include "programs/godwit-eyes/commands.hpp"
#include "programs/godwit-eyes/confinement/confinement.hpp"

namespace godwit::eyes {
namespace {

constexpr std::chrono::milliseconds line_period{1'000};

std::string line_of(const io::video::source_report& now) {
  using io::video::picture_fault;
  using io::video::source_state;
  if (now.state == source_state::opening)
    return now.reason.empty() ? "opening" : "opening again: " + now.reason;
  if (now.state != source_state::playing)
    return now.reason;
  auto result = std::to_string(now.width) + " x " + std::to_string(now.height) + ", " +
                std::to_string(static_cast<int>(now.frames_per_s)) + " pictures a second, " +
                std::to_string(now.frames) + " since the start";
  if (now.fault == picture_fault::black)
    result += "; they are BLACK: is the lens covered?";
  if (now.fault == picture_fault::repeated)
    result += "; it is the SAME picture again and again: the camera has stopped inside";
  return result;
}

exit_code run(const std::string& uri, int seconds) {
  auto from = io::video::parse_camera_uri(uri);
  if (!from) {
    say(io::video::without_password(uri) + ": " + from.error());
    return exit_code::usage;
  }
  if (const auto confined = confine(*from, {}); !confined)
    say("is not shut in: " + confined.error());
  const io::video::source camera(*std::move(from), {}, [] {});
  for (int i = 0; i < seconds; ++i) {
    std::this_thread::sleep_for(line_period);
    std::printf("%s\n", line_of(camera.report()).c_str());
    std::fflush(stdout);
  }
  const auto seen = camera.report();
  return seen.frames > 0 ? exit_code::ok : exit_code::failed;
}

} // namespace

command add_probe_command(CLI::App& to) {
  struct arguments {
    std::string uri;
    int seconds = 5;
  };
  const auto given = std::make_shared<arguments>();
  auto* const app = to.add_subcommand("probe", "Opens a camera, and reports what it sends or why it sends nothing");
  app->add_option("URI", given->uri, "v4l2:///dev/video0, rtsp://..., file:///..., test://ball")->required();
  app->add_option("--seconds", given->seconds, "Watches for so long")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  return {app, [given] { return run(given->uri, given->seconds); }};
}

} // namespace godwit::eyes
