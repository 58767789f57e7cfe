// How much faster than real time the whole daemon flies in virtual time: a mission of a PX4 at its real speed and its
// default streams, from the fetch to the last delivery, in one thread.
//
// `times` is virtual seconds in a second of the processor; `shuffled` draws the order of what happens at the same time,
// as the tests do.
#include <benchmark/benchmark.h>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"

namespace godwit::drill {
namespace {

void whole_flight(benchmark::State& state, sim::personality who, bool is_shuffled) {
  double flown_s = 0;
  std::uint64_t seed = 0;
  for ([[maybe_unused]] auto each : state) {
    flight_simulation flight({.who = who, .seed = ++seed, .speed = 1, .stream_factor = 1, .is_shuffled = is_shuffled});
    const auto began_ns = flight.now_ns();
    if (!flight.run_until_phase(executor::phase::done, 1'800))
      state.SkipWithError("the flight has no end");
    flown_s += static_cast<double>(flight.now_ns() - began_ns) * 1e-9;
  }
  state.counters["flight_s"] = flown_s / static_cast<double>(state.iterations());
  state.counters["times"] = benchmark::Counter(flown_s, benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(whole_flight, px4, sim::personality::px4, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_flight, px4_shuffled, sim::personality::px4, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_flight, ardupilot, sim::personality::ardupilot, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_flight, rover, sim::personality::rover, false)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace godwit::drill
