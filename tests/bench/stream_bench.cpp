// The stream of telemetry: what a delivery costs among many subscribers, and how late a text is at clients of which
// some read nothing.
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "actors/telemetry_stream/hub.hpp"
#include "programs/godwitd/operator_port/operator_port.hpp"
#include "programs/godwitd/operator_port/stream_api.hpp"
#include "tests/io/http/server/websocket_client.hpp"

namespace {

using namespace godwit;
using namespace godwit::telemetry_stream;
using clock_type = std::chrono::steady_clock;

// As long as that of a position.
const std::string data(160, '1');

std::int64_t now_ns() { return clock_type::now().time_since_epoch().count(); }

// One text to all, and taken by all.
void stream_deliver(benchmark::State& state) {
  hub all;
  std::vector<std::shared_ptr<subscriber>> places;
  for (std::int64_t i = 0; i < state.range(0); ++i)
    places.push_back(all.subscribe({{topic::position, 0}}, [] {}).value());
  for (auto& each : places)
    while (each->take())
      ;
  for (auto _ : state) {
    all.publish(topic::position, data, 1, 1);
    for (auto& each : places)
      while (const auto text = each->take())
        benchmark::DoNotOptimize(text->data());
  }
  state.counters["ns_a_delivery"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(state.range(0)),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(stream_deliver)->Name("stream/deliver")->Arg(1)->Arg(20)->Arg(1000);

// 20 clients; so many of them read nothing. Ten texts a second and topic would take too long: a text each 2 ms.
void stream_latency(benchmark::State& state) {
  const auto stalled = state.range(0);
  constexpr std::int64_t clients = 20;
  const auto all = std::make_shared<hub>();
  operator_port::port port;
  const auto api = std::make_shared<operator_port::stream_api>(port.context(), all);
  operator_port::settings wanted{.host = "127.0.0.1", .port = 0, .hosts = {}};
  wanted.max_clients_an_address = clients; // all come from here
  if (!port.open(wanted, api->routes()))
    return state.SkipWithError("no port");
  const auto number = static_cast<std::uint16_t>(std::stoi(port.place().substr(port.place().find(':') + 1)));
  std::vector<std::unique_ptr<io::http::test::websocket_client>> lines;
  for (std::int64_t i = 0; i < clients; ++i)
    lines.push_back(std::make_unique<io::http::test::websocket_client>(number, "/api/v1/stream?topics=position"));
  std::vector<std::vector<double>> late(clients);
  std::vector<std::thread> readers;
  for (std::int64_t i = stalled; i < clients; ++i)
    readers.emplace_back([&, i] {
      for (std::string text = lines[i]->read(); !text.empty(); text = lines[i]->read())
        if (const auto place = text.find("\"data\":"); text.find("position") != std::string::npos)
          late[i].push_back(static_cast<double>(now_ns() - std::stoll(text.substr(place + 7))) * 1e-6);
    });
  for (auto _ : state) {
    all->publish(topic::position, std::to_string(now_ns()) + std::string(1000, ' '), 1, now_ns());
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const auto dropped = all->counts().dropped[static_cast<std::size_t>(topic::position)];
  port.close([&] { api->close(); });
  for (auto& each : readers)
    each.join();
  std::vector<double> together;
  for (const auto& each : late)
    together.insert(together.end(), each.begin(), each.end());
  std::ranges::sort(together);
  if (!together.empty()) {
    state.counters["p50_ms"] = together[together.size() / 2];
    state.counters["p99_ms"] = together[together.size() * 99 / 100];
    state.counters["max_ms"] = together.back();
  }
  state.counters["dropped"] = static_cast<double>(dropped);
}
BENCHMARK(stream_latency)
    ->Name("stream/latency_20_clients_stalled")
    ->Arg(0)
    ->Arg(4)
    ->Iterations(5000)
    ->Unit(benchmark::kMillisecond);

} // namespace
