// The command `vehicle`: simulated vehicles, until they are told to stop.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>

#include <sys/resource.h>
#include <unistd.h>

#include "programs/common/line_printer.hpp"
#include "programs/godwit-sim/commands.hpp"
#include "programs/godwit-sim/vehicle/other_aircraft.hpp"
#include "programs/godwit-sim/vehicle_options.hpp"
#ifdef GODWIT_HAS_EYES
#include "programs/godwit-sim/camera_server/vehicle_camera.hpp"
#endif

namespace godwit::sim {
namespace {

constexpr std::size_t most_listed = 5; // links; the others follow from them

constexpr const char* vehicle_examples =
    R"(Examples:
  godwit-sim vehicle --personality px4
  godwit-sim vehicle --personality ardupilot --link tcpin://127.0.0.1:5760 --home -35.363262,149.165237,584
  godwit-sim vehicle --personality rover --link udpin://0.0.0.0:14540 --speed 20 --arm-on-start
  godwit-sim vehicle --personality px4 --faults loss=0.1,delay=15ms --fault-at "30s=gps lost" --fault-at 60s=reboot
  godwit-sim vehicle --personality px4 --count 10 --link udpin://127.0.0.1:14580 --control 127.0.0.1:14600)";

// With the seconds since the start before each line.
class event_lines {
public:
  explicit event_lines(programs::line_printer& to) : to_(&to) {}

  void operator()(std::string_view line) const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began_;
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%9.3f s  ", elapsed.count());
    to_->push(time.data() + std::string(line));
  }

private:
  programs::line_printer* to_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

// A socket for each line of each vehicle, and some for the rest; the soft limit of a shell is often 1024.
void allow_descriptors(std::size_t vehicles) {
  constexpr rlim_t others = 64;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= vehicles + others)
    return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, vehicles + others);
  ::setrlimit(RLIMIT_NOFILE, &limit); // if not, the link that finds no descriptor says so
}

void introduce(vehicle_host& host, const host_settings& settings, programs::line_printer& to) {
  const auto links = host.links();
  for (std::size_t number = 0; number < std::min(links.size(), most_listed); ++number) {
    const auto& vehicle = settings.vehicles[number].vehicle;
    to.push("vehicle " + std::to_string(number + 1) + ": " + std::string(io::name_of(vehicle.who)) + ", system " +
            std::to_string(vehicle.system) + ", " + links[number]);
    for (const auto& each : host.more_links(number))
      to.push("           and on a line of its own " + each);
  }
  if (links.size() > most_listed)
    to.push("... and so on to vehicle " + std::to_string(links.size()) + ": " + links.back());
  to.push("connect with");
  for (const auto& each : connection_hints(io::link::parse_uri(links.front()).value()))
    to.push(each);
  if (const auto control = host.control(); !control.empty())
    to.push("control port " + control.substr(control.find("//") + 2));
  to.push("Ctrl-C ends it");
}

#ifdef GODWIT_HAS_EYES
using camera_handle = std::unique_ptr<vehicle_camera>;

// None, when none was asked for.
tl::expected<camera_handle, std::string> open_camera(vehicle_host& host, const host_settings& settings) {
  if (!settings.camera)
    return camera_handle();
  auto opened =
      vehicle_camera::open(*settings.camera, settings.vehicles.front().vehicle.home, settings.camera_truth, [&host] {
        vehicle_picture now;
        host.inside([&] { now = host.at(0).describe(); });
        return now;
      });
  if (opened)
    host.inside([&] { host.set_camera([to = opened->get()](bool is_cut) { to->set_cut(is_cut); }); });
  return opened;
}
#else
tl::expected<bool, std::string> open_camera(vehicle_host&, const host_settings& settings) {
  if (settings.camera)
    return tl::make_unexpected("--camera: this godwit-sim was built without the detector (GODWIT_EYES=OFF)");
  return false;
}
#endif

exit_code run(const vehicle_arguments& given) {
  auto settings = read(given);
  if (!settings) {
    say(settings.error());
    return exit_code::usage;
  }
  settings->ends_on_signals = true;
  allow_descriptors(settings->vehicles.size() * given.links.size());
  programs::line_printer printer(STDOUT_FILENO);
  auto host = vehicle_host::open(*settings, event_lines(printer));
  if (!host) {
    say(host.error());
    return exit_code::failed;
  }
  const auto camera = open_camera(**host, *settings);
  if (!camera) {
    say(camera.error());
    return exit_code::failed;
  }
  introduce(**host, *settings, printer);
  (*host)->wait();
  (*host)->inside([&host] { (*host)->set_camera({}); });
  return exit_code::ok;
}

void add_vehicle_options(CLI::App& app, vehicle_arguments& given) {
  app.add_option("--personality", given.personality,
                 "The autopilot that it behaves as: rover, px4, ardupilot, plane, ardurover, quadplane or px4_vtol")
      ->type_name("NAME")
      ->required();
  app.add_option("--link", given.links,
                 "How stations reach it, such as udpin://0.0.0.0:14540 or tcpin://0.0.0.0:5760; again for each line")
      ->type_name("URI")
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--home", given.home, "Where it begins, in degrees and metres above mean sea level")
      ->type_name("LAT,LON,ALT")
      ->capture_default_str();
  app.add_option("--speed", given.speed, "How many times faster than real time the world runs")
      ->type_name("F")
      ->check(CLI::Range(min_speed, max_speed))
      ->capture_default_str();
  app.add_option("--seed", given.seed, "Draws all that is random")->type_name("N")->capture_default_str();
  app.add_option("--system", given.system, "Its MAVLink system id")
      ->type_name("ID")
      ->check(CLI::Range(1, max_system))
      ->capture_default_str();
  app.add_option("--count", given.count, "So many vehicles; ids, listening ports and homes go on from the first")
      ->type_name("N")
      ->check(CLI::Range(1, max_vehicles))
      ->capture_default_str();
  app.add_option("--battery", given.battery, "Its charge at the start")
      ->type_name("PERCENT")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--traffic", given.aircraft, "So many other aircraft that its ADS-B receiver hears")
      ->type_name("N")
      ->check(CLI::Range(0, max_other_aircraft))
      ->capture_default_str();
  app.add_flag("--payload", given.has_payload, "It has a gripper, and a camera whose pictures it reports");
  app.add_flag("--arm-on-start", given.arm_on_start, "rover: MISSION_START arms it");
}

void add_fault_options(CLI::App& app, vehicle_arguments& given) {
  app.add_option("--faults", given.faults, "Of the line, such as loss=0.1,dup=0.01,delay=15ms,jitter=5ms,out.cut")
      ->type_name("TEXT")
      ->capture_default_str();
  app.add_option("--fault-at", given.fault_at,
                 "A fault that comes by itself, such as \"30s=gps lost\"; may be repeated")
      ->type_name("TIME=WHAT")
      ->allow_extra_args(false);
  app.add_option("--refuse", given.refuse, "Answers this command so (DENIED), such as MISSION_START=FAILED; repeatable")
      ->type_name("COMMAND[=RESULT]")
      ->allow_extra_args(false);
  app.add_option("--control", given.control, "Takes requests in JSON on this loopback address (docs/godwit-sim.md)")
      ->type_name("HOST:PORT");
}

} // namespace

command add_vehicle_command(CLI::App& to) {
  auto* const app = to.add_subcommand("vehicle", "Simulates vehicles for any MAVLink ground station.");
  const auto given = std::make_shared<vehicle_arguments>();
  add_vehicle_options(*app, *given);
  add_fault_options(*app, *given);
  app->add_option("--camera", given->camera,
                  "Serves what a camera below it sees, such as rtsp://127.0.0.1:8554/camera?movers=4")
      ->type_name("URI");
  app->add_option("--camera-truth", given->camera_truth,
                  "Writes what is really to be seen into this file, as JSON lines")
      ->type_name("FILE");
  app->add_option("--tlog", given->tlog, "Records what goes over the links into this file")->type_name("FILE");
  app->add_flag("--quiet", given->quiet, "Prints no events");
  app->footer(vehicle_examples);
  return {app, [given] { return run(*given); }};
}

} // namespace godwit::sim
