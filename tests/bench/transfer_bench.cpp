// How long plans take to a vehicle, in virtual time: median_s and worst_s of 200 seeds, and the bytes on the line.
//
// upload/PEER/ITEMS/LOSS%: 15 ms each way, frames lost at random both ways, vehicles with the habits and the timing of
// real ones. upload_radio/...: half-duplex 57600 baud with 60 ms there and back; line_ratio is the time against that of
// the bytes alone, byte_ratio the bytes against those of the same client with a window of 1. The time that the
// benchmark itself shows is what the simulation costs.
#include <benchmark/benchmark.h>

#include "tests/support/upload_figures.hpp"

namespace godwit::bench {

namespace {

using namespace tests;

constexpr int seeds = 200;

void show(benchmark::State& bench, const upload_figures& measured) {
  bench.counters["median_s"] = measured.median_s;
  bench.counters["worst_s"] = measured.worst_s;
  bench.counters["sent_ratio"] = measured.sent_ratio;
  bench.counters["failures"] = measured.failures;
  bench.counters["untruthful"] = measured.untruthful;
}

void upload(benchmark::State& bench, const upload_peer& peer) {
  const auto items = static_cast<int>(bench.range(0));
  const auto loss = static_cast<double>(bench.range(1)) / 100;
  upload_figures measured;
  for (auto _ : bench)
    measured = measure_uploads(peer, network(loss), items, items > 100 ? seeds / 10 : seeds);
  show(bench, measured);
}

void upload_radio(benchmark::State& bench, const upload_peer& peer) {
  const auto items = static_cast<int>(bench.range(0));
  const auto loss = static_cast<double>(bench.range(1)) / 100;
  const auto runs = items > 100 ? seeds / 10 : seeds;
  upload_figures measured;
  for (auto _ : bench)
    measured = measure_uploads(peer, radio(loss), items, runs);
  show(bench, measured);
  constexpr double line_time_100_s = 1.2;
  constexpr double line_time_1000_s = 11.6;
  bench.counters["line_ratio"] = measured.median_s / (items > 100 ? line_time_1000_s : line_time_100_s);
  const auto one_by_one = measure_uploads(request_by_request(peer), radio(loss), items, runs);
  bench.counters["byte_ratio"] = measured.median_bytes / one_by_one.median_bytes;
}

void network_lines(benchmark::internal::Benchmark* each) {
  each->ArgsProduct({{100, 1'000}, {0, 5, 10, 20}})->Unit(benchmark::kMillisecond)->Iterations(1);
}

void radio_lines(benchmark::internal::Benchmark* each) {
  each->ArgsProduct({{100, 1'000}, {0, 5}})->Unit(benchmark::kMillisecond)->Iterations(1);
}

BENCHMARK_CAPTURE(upload, px4, px4_peer())->Apply(network_lines);
BENCHMARK_CAPTURE(upload, copter, copter_peer())->Apply(network_lines);
BENCHMARK_CAPTURE(upload, rover, rover_peer())->Apply(network_lines);
BENCHMARK_CAPTURE(upload_radio, px4, px4_peer())->Apply(radio_lines);
BENCHMARK_CAPTURE(upload_radio, copter, copter_peer())->Apply(radio_lines);

} // namespace

} // namespace godwit::bench
