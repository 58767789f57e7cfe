// What it costs to read a page of the map (JSON, schema, rules, structs), to write a batch of observations, and to read
// a mission as long as one may be.
#include <benchmark/benchmark.h>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission {
namespace {

constexpr const char* key = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

// Different in their last eight digits, as the rows of a page have to be.
std::string id_of_row(std::size_t row) {
  constexpr std::size_t first = 10'000'000;
  const std::string id = key;
  return id.substr(0, id.size() - 8) + std::to_string(first + row);
}

double spread(std::size_t row) { return static_cast<double>(row * 7919 % 100'003) / 100'003; }

map_object_page page_of(std::size_t rows) {
  map_object_page page{std::string(schema_version), {}, "eyJhIjoxMDAwfQ"};
  for (std::size_t i = 0; i < rows; ++i)
    page.map_objects.push_back({id_of_row(i), "vehicle", 47 + spread(i), 8 + spread(i), 400 + spread(i), spread(i),
                                "2026-05-01T08:00:00.123Z", "2026-05-03T16:20:00Z"});
  return page;
}

observation_batch batch_of(std::size_t rows) {
  observation_batch batch{key, {}};
  for (std::size_t i = 0; i < rows; ++i)
    batch.observations.push_back({id_of_row(i), id_of_row(i + rows), observation_kind::moved, "vehicle", 47 + spread(i),
                                  8 + spread(i), 400 + spread(i), spread(i), "2026-05-04T10:15:44.123Z"});
  return batch;
}

document mission_of(std::size_t items) {
  document mission;
  mission.mission_id = key;
  for (std::size_t i = 0; i < items; ++i)
    mission.items.emplace_back(waypoint{std::to_string(i), {47 + spread(i), 8 + spread(i), 40}, 0, 2, {}});
  return mission;
}

template <class T>
void read_again(benchmark::State& state, const T& value, std::size_t rows) {
  const auto text = to_text(value);
  for (auto _ : state)
    if (auto result = read<T>(text); !result)
      state.SkipWithError(result.error().message().c_str());
  state.counters["bytes"] = static_cast<double>(text.size());
  state.counters["s_a_row"] = benchmark::Counter(
      static_cast<double>(rows), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void read_page(benchmark::State& state) {
  const auto rows = static_cast<std::size_t>(state.range(0));
  read_again(state, page_of(rows), rows);
}
BENCHMARK(read_page)->Name("mission/read_map_page")->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

void write_batch(benchmark::State& state) {
  const auto batch = batch_of(500);
  for (auto _ : state)
    benchmark::DoNotOptimize(to_text(batch));
}
BENCHMARK(write_batch)->Name("mission/write_500_observations")->Unit(benchmark::kMillisecond);

void read_mission(benchmark::State& state) {
  const auto items = static_cast<std::size_t>(state.range(0));
  read_again(state, mission_of(items), items);
}
BENCHMARK(read_mission)->Name("mission/read_items")->Arg(100)->Arg(10'000)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace godwit::mission
