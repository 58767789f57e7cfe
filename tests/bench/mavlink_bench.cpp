// How fast the stream of an autopilot becomes messages, and how fast messages become frames.
//
// The recordings are those of tests/data/captures; decoding means scan, checksum of every frame, and every field of the
// messages that godwit reads, in memory.
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::io::mavlink {
namespace {

using byte_buffer = std::vector<std::byte>;

byte_buffer recording(const std::string& name) {
  std::ifstream file(GODWIT_TEST_DATA "/captures/" + name, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

byte_buffer known_frames_of(const byte_buffer& all) {
  byte_buffer result;
  scanner frames;
  frames.feed(all, [&](const frame_view& frame) {
    if (known_messages::contains(frame.id()))
      result.insert(result.end(), frame.bytes().begin(), frame.bytes().end());
  });
  return result;
}

// Decodes BYTES again and again; the whole message is made to exist in memory.
void decode(benchmark::State& state, const byte_buffer& bytes, std::size_t piece_size) {
  std::uint64_t frames = 0;
  std::uint64_t known = 0;
  scanner from_bytes;
  const auto sink = [&](const frame_view& frame) {
    ++frames;
    known += visit(frame, [](const auto& message) { benchmark::DoNotOptimize(message); }) ? 1 : 0;
  };
  for (auto _ : state)
    for (std::size_t at = 0; at < bytes.size(); at += piece_size)
      from_bytes.feed(byte_view(bytes).subspan(at, std::min(piece_size, bytes.size() - at)), sink);
  if (frames == 0 || from_bytes.counters().bad_crc != 0)
    state.SkipWithError("the recording did not decode");
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
  state.SetItemsProcessed(static_cast<std::int64_t>(frames));
  state.counters["per_frame"] =
      benchmark::Counter(static_cast<double>(frames), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["known"] = static_cast<double>(known) / static_cast<double>(state.iterations());
}

void decode_recording(benchmark::State& state) { decode(state, recording("px4_quad_mission.rx.bin"), SIZE_MAX); }
BENCHMARK(decode_recording)->Name("decode/px4_quad_mission");

void decode_known(benchmark::State& state) {
  decode(state, known_frames_of(recording("px4_quad_mission.rx.bin")), SIZE_MAX);
}
BENCHMARK(decode_known)->Name("decode/known_only");

// As a serial line gives them: the frames lie across the edges of the pieces.
void decode_pieces(benchmark::State& state) { decode(state, recording("px4_quad_mission.rx.bin"), 64); }
BENCHMARK(decode_pieces)->Name("decode/in_pieces_of_64");

void decode_rover(benchmark::State& state) { decode(state, recording("ardurover_mission.rx.bin"), SIZE_MAX); }
BENCHMARK(decode_rover)->Name("decode/ardurover_mission");

// Garbage that repeats PATTERN, from somebody who was heard before.
void scan_garbage(benchmark::State& state, std::span<const std::uint8_t> pattern) {
  byte_buffer bytes(1U << 20U);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::byte>(pattern[i % pattern.size()]);
  scanner from_bytes;
  from_bytes.feed(encode(heartbeat{}, {0xFD, 100}, 0).span(), [](const frame_view&) {});
  for (auto _ : state)
    from_bytes.feed(bytes, [](const frame_view& frame) { benchmark::DoNotOptimize(frame); });
  if (from_bytes.counters().garbage_bytes == 0)
    state.SkipWithError("this was no garbage");
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

// The dearest there is: every fifth byte begins what claims to be the longest frame of a known id.
constexpr std::array<std::uint8_t, 5> known_starts{0xFD, 0xFF, 0, 0, 0};
BENCHMARK_CAPTURE(scan_garbage, known, known_starts)->Name("scan/garbage_of_known_ids");

// Every tenth begins one of an unknown id that must be searched for good frames, and holds what look like some.
constexpr std::array<std::uint8_t, 10> unknown_starts{0xFD, 100, 0, 0, 1, 0xFD, 243, 0, 0, 0};
BENCHMARK_CAPTURE(scan_garbage, unknown, unknown_starts)->Name("scan/garbage_of_unknown_ids");

void encode_position(benchmark::State& state) {
  global_position_int position{1000, 500000000, 364000000, 900000, 800000, 100, -50, 0, 9000};
  std::uint8_t sequence = 0;
  std::int64_t bytes = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(position);
    const auto frame = encode(position, {1, 1}, sequence++);
    benchmark::DoNotOptimize(frame);
    bytes += static_cast<std::int64_t>(frame.size());
  }
  state.SetBytesProcessed(bytes);
}
BENCHMARK(encode_position)->Name("encode/global_position_int");

void checksum(benchmark::State& state) {
  byte_buffer bytes(static_cast<std::size_t>(state.range(0)), std::byte{0x5A});
  for (auto _ : state) {
    benchmark::DoNotOptimize(bytes.data());
    benchmark::DoNotOptimize(crc_of(bytes));
  }
  state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(checksum)->Name("crc")->Arg(21)->Arg(44)->Arg(267);

} // namespace
} // namespace godwit::io::mavlink
