// What the map costs with a million objects on it: deciding what a sighting is, making it durable, replacing the map.
//
// The file lies in the current directory, which should be on the disk that is to be measured (not on tmpfs). It is made
// once for all of these and takes about a minute.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <random>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/map_writer.hpp"
#include "actors/mapobjects_store/pass_review.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "runtime/assert.hpp"

namespace {

using namespace godwit;
using namespace godwit::mapobjects_store;
using std::chrono::steady_clock;

constexpr const char* mission = "00000000-0000-4000-8000-000000000001";
constexpr std::size_t all_objects = 1'000'000;
constexpr std::size_t page_objects = 1000;
constexpr double area_m = 30'000; // a square, so that a circle of 30 m holds three objects
constexpr int class_groups = 4;

// Ids, places and choices of one benchmark; the same in every run.
class source {
public:
  explicit source(std::uint64_t seed) : random_(seed) {}

  std::string id() {
    std::array<char, 37> text{};
    std::snprintf(text.data(), text.size(), "%08x-%04x-4%03x-8%03x-%012llx", static_cast<unsigned>(random_()),
                  static_cast<unsigned>(random_() & 0xffff), static_cast<unsigned>(random_() & 0xfff),
                  static_cast<unsigned>(random_() & 0xfff),
                  static_cast<unsigned long long>(random_() & 0xffffffffffff));
    return text.data();
  }

  geo_position place() {
    std::uniform_real_distribution<double> metres(-area_m / 2, area_m / 2);
    const auto east = geo::destination({48, 16}, 90, metres(random_));
    const auto at = geo::destination(east, 0, metres(random_));
    return {at.latitude_deg, at.longitude_deg, 150.0};
  }

  std::string group() { return "group " + std::to_string(random_() % class_groups); }

  sighting seen() {
    return {
        .id = id(), .mission_id = mission, .class_group = group(), .position = place(), .at_ns = 1, .confidence = 0.5};
  }

  map_object object() {
    return {.id = id(),
            .mission_id = mission,
            .class_group = group(),
            .position = place(),
            .first_seen_ns = 1,
            .last_seen_ns = 1,
            .confidence = 0.5};
  }

private:
  std::mt19937_64 random_;
};

double ms_since(steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(steady_clock::now() - start).count();
}

// Of the calling thread, which no other program can make longer.
double cpu_ms() {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) * 1e3 + static_cast<double>(used.tv_nsec) / 1e6;
}

double process_cpu_ms() {
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) * 1e3 + static_cast<double>(used.tv_nsec) / 1e6;
}

double resident_mib() {
  std::ifstream status("/proc/self/statm");
  long total = 0;
  long resident = 0;
  status >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024 * 1024);
}

// One ask after the other, each answered before the next.
class asker {
public:
  explicit asker(map_writer& writer) : writer_(writer) {}

  template <class Work>
  auto ask(Work work) {
    using result = decltype(work(std::declval<map_tables&>()));
    std::optional<result> answer;
    check(writer_.post(std::move(work), [&](const result& done) {
      answer.emplace(done);
      answered_.release();
    }));
    answered_.acquire();
    check(*answer);
    return std::move(**answer);
  }

  void load(std::uint64_t seed, std::size_t objects) {
    source made(seed);
    const auto number = ask([](map_tables& t) { return begin(t, {mission}); }).number;
    const auto answer = [this](const map_result<void>& done) {
      check(done);
      answered_.release();
    };
    for (std::size_t given = 0; given < objects; given += page_objects) {
      load_page page{
          .load = number, .number = static_cast<std::int64_t>(given / page_objects), .objects = {}, .ignored = {}};
      for (std::size_t i = 0; i < page_objects; ++i)
        page.objects.push_back(made.object());
      const auto start = steady_clock::now();
      check(writer_.add_page(std::move(page), answer));
      answered_.acquire();
      waited_ms_ += ms_since(start);
    }
    const finish_load end{.load = number, .objects = static_cast<std::int64_t>(objects), .ignored = 0, .at_ns = 1};
    const auto start = steady_clock::now();
    check(writer_.finish(end, answer));
    answered_.acquire();
    finish_ms_ = ms_since(start);
    waited_ms_ += finish_ms_;
  }

  [[nodiscard]] double waited_ms() const { return waited_ms_; } // for a load, without the making of objects
  [[nodiscard]] double finish_ms() const { return finish_ms_; }

private:
  template <class Result>
  static void check(const Result& done) {
    GODWIT_ASSERT(done.has_value(), done ? "" : done.error().message());
  }

  map_writer& writer_;
  std::binary_semaphore answered_{0};
  double waited_ms_ = 0;
  double finish_ms_ = 0;
};

void remove_files(const std::string& path) {
  for (const auto* suffix : {"", "-wal", "-shm", ".lock", ".new"})
    std::remove((path + suffix).c_str());
}

std::unique_ptr<map_writer> open_writer(const std::string& path) {
  auto opened = map_writer::open({.store = {.file = {.path = path}, .rules = {}}});
  GODWIT_ASSERT(opened.has_value(), opened ? "" : opened.error().message());
  return std::move(*opened);
}

// A map in the current directory that leaves nothing behind.
class bench_map {
public:
  static bench_map& instance() {
    static bench_map made;
    return made;
  }

  map_store_options options() const { return {.file = {.path = path_}, .rules = {}}; }

  std::unique_ptr<map_writer> writer() const { return open_writer(path_); }

private:
  bench_map() : path_("godwit_bench_map_" + std::to_string(::getpid()) + ".db") {
    remove_files(path_);
    const auto open = writer();
    asker(*open).load(1, all_objects);
  }
  ~bench_map() { remove_files(path_); }

  std::string path_;
};

void report(benchmark::State& state, std::vector<double> times_ms) {
  std::sort(times_ms.begin(), times_ms.end());
  const auto at = [&](double share) {
    return times_ms[std::min(times_ms.size() - 1,
                             static_cast<std::size_t>(share * static_cast<double>(times_ms.size())))];
  };
  state.counters["p50_ms"] = at(0.5);
  state.counters["p99_ms"] = at(0.99);
  state.counters["max_ms"] = times_ms.back();
}

// From the sighting to what it is, the rows that it changes included, the disk not.
void decision(benchmark::State& state) {
  constexpr int sightings = 20'000;
  constexpr int in_transaction = 20;
  auto store = map_store::open(bench_map::instance().options());
  GODWIT_ASSERT(store.has_value(), "bench: open");
  source made(2);
  std::vector<double> times_ms;
  std::vector<double> used_ms; // of the processor
  std::array<int, 5> kinds{};
  for (auto _ : state) {
    for (int i = 0; i < sightings; ++i) {
      if (i % in_transaction == 0)
        GODWIT_ASSERT((*store)->begin(), "bench: begin");
      const auto seen = made.seen();
      const auto start = steady_clock::now();
      const auto cpu_start_ms = cpu_ms();
      auto done = (*store)->apply([&](map_tables& t) {
        return record(t, seen).map(
            [&](const observed& answer) { ++kinds[static_cast<std::size_t>(answer.what.kind)]; });
      });
      used_ms.push_back(cpu_ms() - cpu_start_ms);
      times_ms.push_back(ms_since(start));
      GODWIT_ASSERT(done.has_value(), "bench: record");
      if (i % in_transaction == in_transaction - 1)
        GODWIT_ASSERT((*store)->commit(), "bench: commit");
    }
  }
  std::sort(used_ms.begin(), used_ms.end());
  state.counters["cpu_p50_ms"] = used_ms[used_ms.size() / 2];
  state.counters["cpu_p99_ms"] = used_ms[used_ms.size() * 99 / 100];
  report(state, std::move(times_ms));
  state.counters["new"] = kinds[0];
  state.counters["moved"] = kinds[1];
  state.counters["existing"] = kinds[2];
}

// Sightings at a steady rate, each timed from the call to the answer; returns the times.
class traffic {
public:
  traffic(map_writer& writer, std::uint64_t seed) : writer_(writer), made_(seed) {}

  void send(std::size_t index) {
    const auto start = steady_clock::now();
    const auto done = [this, start, index](const map_result<observed>& answer) {
      GODWIT_ASSERT(answer.has_value(), answer ? "" : answer.error().message());
      times_ms_[index] = ms_since(start);
      if (ended_.fetch_add(1) + 1 == times_ms_.size())
        all_ended_.release();
    };
    GODWIT_ASSERT(writer_.post([seen = made_.seen()](map_tables& t) { return record(t, seen); }, done),
                  "bench: a sighting was refused");
  }

  std::vector<double> run(std::size_t count, std::chrono::nanoseconds each) {
    times_ms_.assign(count, 0);
    const auto start = steady_clock::now();
    for (std::size_t i = 0; i < count; ++i) {
      std::this_thread::sleep_until(start + i * each);
      send(i);
    }
    all_ended_.acquire();
    return times_ms_;
  }

private:
  map_writer& writer_;
  source made_;
  std::vector<double> times_ms_;
  std::atomic<std::size_t> ended_{0};
  std::binary_semaphore all_ended_{0};
};

// What people are shown of a part of the map: one that shows all of it, and those that show some of it. Decisions wait
// as long.
void look(benchmark::State& state) {
  constexpr int looks = 200;
  const auto writer = bench_map::instance().writer();
  asker viewer(*writer);
  source made(11);
  std::vector<double> times_ms;
  for (auto _ : state) {
    for (int i = 0; i < looks; ++i) {
      get_objects asked;
      const auto at = made.place();
      const auto degrees = 0.001 * (i % 20); // to 0.02: 4 km, and some thousand objects
      if (i % 10 != 0)
        asked.within = {at.longitude_deg - degrees, at.latitude_deg - degrees, at.longitude_deg + degrees,
                        at.latitude_deg + degrees};
      const auto start = steady_clock::now();
      benchmark::DoNotOptimize(viewer.ask([=](map_tables& t) { return look_at_objects(t, asked); }));
      times_ms.push_back(ms_since(start));
    }
  }
  report(state, std::move(times_ms));
}

void durable(benchmark::State& state, std::size_t count, std::chrono::nanoseconds each) {
  auto writer = bench_map::instance().writer();
  std::vector<double> times_ms;
  const auto start_ms = process_cpu_ms();
  for (auto _ : state)
    times_ms = traffic(*writer, 3 + count).run(count, each);
  state.counters["cpu_ms_each"] = (process_cpu_ms() - start_ms) / static_cast<double>(count);
  const auto status = writer->status();
  state.SetItemsProcessed(static_cast<std::int64_t>(count));
  state.counters["sightings_per_commit"] =
      static_cast<double>(status.changes) / static_cast<double>(std::max<std::uint64_t>(1, status.commits));
  report(state, std::move(times_ms));
}

// The map is replaced by 100,000 objects while 30 sightings a second come in.
void replace_map(benchmark::State& state) {
  auto writer = bench_map::instance().writer();
  const double before_mib = resident_mib();
  double most_mib = before_mib;
  std::vector<double> times_ms;
  asker pull(*writer);
  for (auto _ : state) {
    std::atomic<bool> over{false};
    std::thread beside([&] {
      while (!over) {
        const auto more = traffic(*writer, times_ms.size() + 77).run(10, std::chrono::milliseconds(33));
        times_ms.insert(times_ms.end(), more.begin(), more.end());
        most_mib = std::max(most_mib, resident_mib());
      }
    });
    const auto start_ms = process_cpu_ms();
    pull.load(5, 100'000);
    state.counters["cpu_ms"] = process_cpu_ms() - start_ms; // the making of the objects included
    over = true;
    beside.join();
  }
  state.counters["load_ms"] = pull.waited_ms();
  state.counters["finish_ms"] = pull.finish_ms();
  state.counters["memory_mib"] = most_mib - before_mib;
  report(state, std::move(times_ms));
}

// A map in a file of its own, empty.
class empty_map {
public:
  empty_map() : path_("godwit_bench_empty_" + std::to_string(::getpid()) + ".db") {
    remove_files(path_);
    writer_ = open_writer(path_);
  }
  ~empty_map() {
    writer_.reset();
    remove_files(path_);
  }
  empty_map(const empty_map&) = delete;
  empty_map& operator=(const empty_map&) = delete;

  [[nodiscard]] map_writer& writer() { return *writer_; }

private:
  std::string path_;
  std::unique_ptr<map_writer> writer_;
};

void load_into_empty(benchmark::State& state) {
  empty_map map;
  asker pull(map.writer());
  const auto start_ms = process_cpu_ms();
  for (auto _ : state)
    pull.load(7, 100'000);
  state.counters["cpu_ms"] = process_cpu_ms() - start_ms; // the making of the objects included
  state.counters["load_ms"] = pull.waited_ms();
  state.counters["finish_ms"] = pull.finish_ms();
}

// 50,000 observations are taken in batches of 500, and each is said to be delivered.
void deliver_all(benchmark::State& state) {
  constexpr std::size_t observations = 50'000;
  constexpr std::uint32_t in_batch = 500;
  empty_map map;
  for (std::uint64_t part = 0; part < 10; ++part) // the writer's queue is bounded
    (void)traffic(map.writer(), 90 + part).run(observations / 10, std::chrono::nanoseconds(0));
  asker delivery(map.writer());
  source made(10);
  std::size_t delivered = 0;
  const auto start_ms = process_cpu_ms();
  for (auto _ : state) {
    for (;;) {
      const take_batch asked{
          .key = made.id(), .mission_id = mission, .to = destination::observations, .limit = in_batch};
      const auto given = delivery.ask([=](map_tables& t) { return take(t, asked); });
      if (given.observations.empty())
        break;
      delivered += given.observations.size();
      delivery.ask([=](map_tables& t) { return deliver(t, {asked.key}).map([] { return true; }); });
    }
  }
  GODWIT_ASSERT(delivered == observations, "bench: all of them are delivered");
  state.counters["cpu_ms"] = process_cpu_ms() - start_ms;
}

const bool are_registered = [] {
  using namespace std::chrono_literals;
  const auto add = [](const char* name, auto run) {
    benchmark::RegisterBenchmark(name, run)->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(1);
  };
  add("mapobjects/decision/1000000", decision);
  add("mapobjects/look/1000000", look);
  add("mapobjects/durable/30_per_s", [](benchmark::State& state) { durable(state, 300, 33ms); });
  add("mapobjects/durable/2000_per_s", [](benchmark::State& state) { durable(state, 10'000, 500us); });
  add("mapobjects/durable/all_at_once", [](benchmark::State& state) { durable(state, 9'000, 0ns); });
  add("mapobjects/load/100000", load_into_empty);
  add("mapobjects/deliver/50000", deliver_all);
  add("mapobjects/replace/100000", replace_map);
  return true;
}();

} // namespace
