// How fast messages become MCAP: the trace renders up to a million a second, and this must not be what limits it.
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "io/mcap/rotating_writer.hpp"

namespace godwit::io::mcap {
namespace {

// Messages of 200 bytes on 8 channels through rotation and deletion, flushed every 10,000 as by a tick.
void write_200b(benchmark::State& state) {
  const auto folder = std::filesystem::temp_directory_path() / ("godwit-mcap-bench-" + std::to_string(::getpid()));
  rotating_writer writer;
  rotating_writer_options options;
  options.segments.folder = folder;
  options.segments.total_bytes = 4 * max_segment_bytes;
  if (const auto opened = writer.open(options); !opened) {
    state.SkipWithError(opened.error().message().c_str());
    return;
  }
  channel_id first{};
  for (int i = 0; i < 8; ++i) {
    const auto channel = writer.add_channel(schema_id{0}, "/channel/" + std::to_string(i), "json");
    first = i == 0 ? *channel : first;
  }
  const std::string payload(200, 'x');
  std::uint32_t n = 0;
  for (auto _ : state) {
    const auto channel = static_cast<channel_id>(static_cast<unsigned>(first) + n % 8);
    const auto written = writer.write({channel, n, n, n, bytes_of(payload)});
    if (!written) {
      state.SkipWithError(written.error().message().c_str());
      break;
    }
    if (++n % 10'000 == 0) {
      static_cast<void>(writer.flush());
    }
  }
  state.SetItemsProcessed(state.iterations());
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(payload.size()));
  static_cast<void>(writer.close());
  std::filesystem::remove_all(folder);
}
BENCHMARK(write_200b)->Name("mcap/write/200B");

} // namespace
} // namespace godwit::io::mcap
