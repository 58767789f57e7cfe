// The command `look`: what the detector sees in a recording, as a table and drawn into pictures.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "programs/godwit-eyes/commands.hpp"
#include "programs/godwit-eyes/look/look.hpp"

namespace godwit::eyes {
namespace {

constexpr double longest_s = 24 * 3600;
constexpr double camera_s = 10; // of a camera, which has no end, when nothing else is said

struct arguments {
  std::string from;
  look_settings wanted;
};

tl::expected<io::video::camera_uri, std::string> source_of(const std::string& text) {
  if (text.find("://") != std::string::npos)
    return io::video::parse_camera_uri(text);
  std::error_code failed;
  const auto path = std::filesystem::absolute(text, failed);
  if (failed)
    return tl::make_unexpected(failed.message());
  return io::video::recording_at(path.string());
}

exit_code run(arguments given) {
  auto from = source_of(given.from);
  if (!from) {
    say(io::video::without_password(given.from) + ": " + from.error());
    return exit_code::usage;
  }
  given.wanted.from = *std::move(from);
  if (given.wanted.from.kind != io::video::camera_kind::file && given.wanted.seconds == 0)
    given.wanted.seconds = camera_s;
  const auto seen = look_through(given.wanted);
  if (!seen) {
    say(seen.error());
    return exit_code::failed;
  }
  std::fputs(table_of(*seen).c_str(), stdout);
  if (!given.wanted.folder.empty())
    std::printf("drawn      %d pictures in %s\n", seen->drawn, given.wanted.folder.c_str());
  return exit_code::ok;
}

} // namespace

command add_look_command(CLI::App& to) {
  const auto given = std::make_shared<arguments>();
  auto* const app = to.add_subcommand("look", "Runs the detector over a recording, and shows what it finds and misses");
  auto& wanted = given->wanted;
  app->add_option("FILE", given->from, "A recording; or a camera as for probe, for --seconds (10)")->required();
  app->add_option("--out", wanted.folder, "Draws pictures into this folder, which is made and must be empty");
  app->add_option("--boxes", wanted.boxes, "Writes what it found into this file: frame,track,x,y,w,h,score");
  app->add_option("--use", wanted.use, "Writes into this file whether each picture was of use: frame,usable");
  app->add_option("--model", wanted.model,
                  "A net that says what things look like: NAME.weights beside NAME.cfg, or NAME.onnx");
  app->add_option("--every", wanted.every, "Draws one of so many pictures")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app->add_option("--most", wanted.most_drawn, "Draws so many at most")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  app->add_option("--from", wanted.begin_s, "Begins so many seconds after the first picture")
      ->check(CLI::Range(0.0, longest_s));
  app->add_option("--seconds", wanted.seconds, "Ends after so many; 0: at the end")->check(CLI::Range(0.0, longest_s));
  return {app, [given] { return run(*given); }};
}

} // namespace godwit::eyes
