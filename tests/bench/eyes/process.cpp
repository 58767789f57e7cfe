#include "tests/bench/eyes/process.hpp"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>
#include <variant>

#include <unistd.h>

#include "io/eyes/helper.hpp"
#include "io/video/jpeg_encoder.hpp"
#include "io/video/recorder.hpp"
#include "tests/support/eyes/generated_frame.hpp"
#include "tests/support/eyes/pose_of_view.hpp"

namespace godwit::eyes::test {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using sim::camera::suite_case;

constexpr std::int64_t frame_ns = 33'333'333;
constexpr int jpeg_quality = 85;
constexpr std::uint64_t largest_recording = 2'000'000'000;
constexpr auto opening_limit = 20s;
constexpr auto settling = 2s; // after the first picture: the background is young before
constexpr auto rest = 1s;     // before the end of the recording
constexpr auto pose_period = 100ms;

std::int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

// A folder of its own, deleted at the end.
class scratch {
public:
  scratch() : path_((fs::temp_directory_path() / ("godwit_bench_eyes_" + std::to_string(::getpid()))).string()) {
    fs::create_directories(path_);
  }
  ~scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  scratch(const scratch&) = delete;
  scratch& operator=(const scratch&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

private:
  std::string path_;
};

tl::expected<std::string, std::string> record(const suite_case& flight, int frames, const std::string& folder) {
  io::video::jpeg_encoder encoder(jpeg_quality);
  io::video::recorder to({folder, largest_recording, 3600s});
  for (int n = 0; n < frames; ++n) {
    const auto frame = frame_of(flight.frame(n).seen, (n + 1) * frame_ns);
    const auto jpeg = encoder.encode(frame);
    if (!jpeg)
      return tl::make_unexpected(jpeg.error());
    to.add(*jpeg, frame.captured_ns, frame.width, frame.height);
    if (to.report().dropped > 0 || !to.report().error.empty())
      return tl::make_unexpected("the flight can not be recorded in " + folder + ": " + to.report().error);
  }
  for (const auto& each : fs::directory_iterator(folder))
    return each.path().string();
  return tl::make_unexpected("nothing was recorded in " + folder);
}

// The child of this process that is a godwit-eyes; 0: there is none.
pid_t helper_process() {
  for (const auto& each : fs::directory_iterator("/proc")) {
    std::ifstream file(each.path() / "stat");
    pid_t number = 0;
    std::string name;
    std::string state;
    pid_t parent = 0;
    if (file >> number >> name >> state >> parent && parent == ::getpid() && name == "(godwit-eyes)" && state != "Z")
      return number;
  }
  return 0;
}

double processor_s(pid_t who) {
  std::ifstream file("/proc/" + std::to_string(who) + "/stat");
  std::string all((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::istringstream fields(all.substr(std::min(all.size(), all.rfind(')') + 2)));
  std::string skipped;
  for (int n = 0; n < 11; ++n)
    fields >> skipped;
  double user = 0;
  double system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

// A line of /proc/WHO/status in megabytes.
double memory_mb(pid_t who, const std::string& name) {
  std::ifstream file("/proc/" + std::to_string(who) + "/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":"))
      return std::stod(line.substr(name.size() + 1)) * 1024 / 1e6;
  return 0;
}

// What it says, as it arrives.
class listening {
public:
  [[nodiscard]] io::eyes::helper_listener listener() {
    return {[this](std::uint32_t, const io::eyes::message& said) { hear(said); },
            [this](std::uint32_t, const std::string& why) {
              const std::lock_guard guard(mutex_);
              ended_ = why;
            }};
  }
  void begin_to_count() {
    const std::lock_guard guard(mutex_);
    latencies_ms_.clear();
  }
  struct heard {
    io::eyes::status status;
    std::vector<double> latencies_ms;
    std::string ended;
  };
  [[nodiscard]] heard now() const {
    const std::lock_guard guard(mutex_);
    return {status_, latencies_ms_, ended_};
  }

private:
  void hear(const io::eyes::message& said) {
    const auto arrived_ns = monotonic_ns();
    const std::lock_guard guard(mutex_);
    if (const auto* status = std::get_if<io::eyes::status>(&said))
      status_ = *status;
    if (const auto* seen = std::get_if<io::eyes::candidates>(&said))
      latencies_ms_.push_back(static_cast<double>(arrived_ns - seen->captured_ns) * 1e-6);
  }
  mutable std::mutex mutex_;
  io::eyes::status status_;
  std::vector<double> latencies_ms_;
  std::string ended_;
};

io::eyes::pose message_of(const camera_pose& pose) {
  io::eyes::pose result;
  result.at_ns = pose.at_ns;
  result.w = pose.attitude.w;
  result.x = pose.attitude.x;
  result.y = pose.attitude.y;
  result.z = pose.attitude.z;
  result.rate_x_rad_s = pose.rate.x_rad_s;
  result.rate_y_rad_s = pose.rate.y_rad_s;
  result.rate_z_rad_s = pose.rate.z_rad_s;
  result.latitude_deg = pose.latitude_deg;
  result.longitude_deg = pose.longitude_deg;
  result.height_m = pose.height_m;
  result.attitude_sd_rad = pose.attitude_sd_rad;
  result.position_sd_m = pose.position_sd_m;
  result.height_sd_m = pose.height_sd_m;
  return result;
}

// Does what godwitd does, until UNTIL_NS: poses, and somebody who looks. BEGAN_NS: the first picture of the flight.
void fly(io::eyes::helper& eyes, const suite_case& flight, std::int64_t began_ns, std::int64_t until_ns) {
  for (auto now = monotonic_ns(); now < until_ns; now = monotonic_ns()) {
    const auto view = flight.view_at(static_cast<double>(now - began_ns) * 1e-9);
    static_cast<void>(eyes.send(message_of(pose_of(view, now)))); // one that finds no room is old in a moment
    static_cast<void>(eyes.send(io::eyes::want_picture{now + 1'000'000'000, 200}));
    std::this_thread::sleep_for(pose_period);
  }
}

// The time of the first picture, as far as a status tells; the error says why there is none.
tl::expected<std::int64_t, std::string> wait_for_pictures(const listening& ear) {
  const auto until = std::chrono::steady_clock::now() + opening_limit;
  while (std::chrono::steady_clock::now() < until) {
    const auto heard = ear.now();
    if (!heard.ended.empty())
      return tl::make_unexpected(heard.ended);
    if (heard.status.frames > 0)
      return heard.status.at_ns - static_cast<std::int64_t>(heard.status.frames) * frame_ns;
    std::this_thread::sleep_for(20ms);
  }
  return tl::make_unexpected("no picture came within 20 s: " + ear.now().status.reason);
}

} // namespace

tl::expected<process_figures, std::string> measure_process(const process_options& options) {
  const scratch folder;
  const suite_case flight(sim::camera::tuning_seed(options.seed), sim::camera::tier::a);
  const auto recording = record(flight, options.seconds * 30, folder.path() + "/flight");
  if (!recording)
    return tl::make_unexpected(recording.error());
  listening ear; // outlives the helper
  auto eyes = io::eyes::helper::make({options.program, "session"});
  if (!eyes)
    return tl::make_unexpected(eyes.error());
  (*eyes)->attach(ear.listener());
  const auto& glass = flight.maker().glass();
  io::eyes::begin wanted;
  wanted.uri = "file://" + *recording;
  wanted.width_px = glass.width;
  wanted.height_px = glass.height;
  wanted.focal_px = glass.focal_px;
  if (options.has_recording) {
    wanted.record_folder = folder.path() + "/kept";
    wanted.record_max_mb = 1000;
  }
  (*eyes)->start(1, wanted);
  const auto began_ns = wait_for_pictures(ear);
  if (!began_ns)
    return tl::make_unexpected(began_ns.error());
  const auto end_ns = *began_ns + options.seconds * 1'000'000'000LL - std::chrono::nanoseconds(rest).count();
  fly(**eyes, flight, *began_ns, *began_ns + std::chrono::nanoseconds(settling).count());

  const pid_t who = helper_process();
  const auto before = ear.now().status;
  const double spent_s = processor_s(who);
  const auto from_ns = monotonic_ns();
  ear.begin_to_count();
  fly(**eyes, flight, *began_ns, (from_ns + end_ns) / 2);
  process_figures result;
  result.resident_mb = memory_mb(who, "VmRSS");
  fly(**eyes, flight, *began_ns, end_ns);
  result.most_resident_mb = memory_mb(who, "VmHWM");
  result.seconds = static_cast<double>(monotonic_ns() - from_ns) * 1e-9;
  result.share = (processor_s(who) - spent_s) / result.seconds;
  const auto heard = ear.now();
  if (who == 0 || !heard.ended.empty())
    return tl::make_unexpected("godwit-eyes has ended: " + heard.ended);
  result.latencies_ms = heard.latencies_ms;
  result.frames = heard.status.frames - before.frames;
  result.dropped = heard.status.dropped - before.dropped;
  result.usable = heard.status.usable - before.usable;
  result.pictures = heard.status.pictures - before.pictures;
  return result;
}

} // namespace godwit::eyes::test
