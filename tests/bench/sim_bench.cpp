// What a fleet of simulated vehicles in one process costs in real time: ArduPilots at their default stream rates, each
// on a UDP link of its own, with a station that hears all of them.
//
// CPU is that of the host's thread, which does everything for the vehicles but what the kernel does for the receiver;
// memory is what the process has grown by in the end.
#include <chrono>
#include <fstream>
#include <thread>

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include "programs/godwit-sim/host/vehicle_host.hpp"
#include "tests/support/fleet_station.hpp"

namespace godwit::sim {
namespace {

using namespace std::chrono_literals;

constexpr auto measured = 10s;
constexpr auto patience = 60s; // until all of them fly
constexpr int max_system = 250;

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0;
  double resident = 0;
  statm >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double cpu_seconds(const rusage& used) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double cpu_of_host_s(vehicle_host& host) {
  rusage used{};
  host.inside([&] { ::getrusage(RUSAGE_THREAD, &used); });
  return cpu_seconds(used);
}

double cpu_of_process_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return cpu_seconds(used);
}

host_settings fleet_of(std::int64_t vehicles) {
  host_settings settings;
  settings.is_quiet = true;
  for (std::int64_t n = 0; n < vehicles; ++n) {
    hosted_settings each{.vehicle = {},
                         .where = *io::link::parse_uri("udpin://127.0.0.1:0"),
                         .more_lines = {},
                         .faults = {},
                         .refusals = {}};
    each.vehicle.who = personality::ardupilot;
    each.vehicle.system = static_cast<std::uint8_t>(n % max_system + 1);
    each.vehicle.seed = static_cast<std::uint64_t>(n);
    each.vehicle.endurance_s = 10'000;
    settings.vehicles.push_back(each);
  }
  return settings;
}

std::vector<tests::fleet_station::vehicle> members_of(vehicle_host& host) {
  std::vector<tests::fleet_station::vehicle> members;
  for (const auto& link : host.links())
    members.push_back({io::link::parse_uri(link)->port, static_cast<std::uint8_t>(members.size() % max_system + 1)});
  return members;
}

bool wait_until_ready(const tests::fleet_station& station, std::size_t vehicles, bool is_flying) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end) {
    if (station.heard_from() == vehicles && (!is_flying || station.flying() == vehicles))
      return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

void allow_descriptors() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

void fleet(benchmark::State& state) {
  const auto vehicles = state.range(0);
  const bool is_flying = state.range(1) != 0;
  allow_descriptors();
  for (auto _ : state) {
    ::malloc_trim(0); // what was freed before does not hide what is needed now
    const auto resident_before = resident_bytes();
    auto host = vehicle_host::open(fleet_of(vehicles), [](std::string_view) {});
    if (!host)
      return state.SkipWithError(host.error().c_str());
    const tests::fleet_station station(members_of(**host), is_flying);
    if (!wait_until_ready(station, static_cast<std::size_t>(vehicles), is_flying))
      return state.SkipWithError("not all vehicles were ready in time");
    const auto cpu_before_s = cpu_of_host_s(**host);
    const auto process_before_s = cpu_of_process_s();
    const auto frames_before = station.frames();
    const auto began = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(measured);
    const auto cpu_s = cpu_of_host_s(**host) - cpu_before_s;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    const auto per_second = [&](double all) { return all / took.count(); };
    state.counters["core_share"] = per_second(cpu_s);
    state.counters["process_core_share"] = per_second(cpu_of_process_s() - process_before_s);
    state.counters["cpu_us_per_vehicle_s"] = per_second(cpu_s) * 1e6 / static_cast<double>(vehicles);
    state.counters["messages_per_s"] = per_second(static_cast<double>(station.frames() - frames_before));
    const auto resident = resident_bytes() - resident_before;
    state.counters["resident_kB_per_vehicle"] = resident / 1e3 / static_cast<double>(vehicles);
  }
}
BENCHMARK(fleet)
    ->Name("sim/fleet")
    ->ArgNames({"vehicles", "flying"})
    ->Args({1'000, 0})
    ->Args({1'000, 1})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

} // namespace
} // namespace godwit::sim
