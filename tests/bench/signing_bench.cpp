// What a signature costs a frame that goes out, and one that comes in.
#include <benchmark/benchmark.h>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "io/mavlink/signing/strip_signature.hpp"
#include "io/mavlink/signing/verifier.hpp"

namespace godwit::io::mavlink {
namespace {

constexpr std::int64_t some_day_ns = 1'781'000'000'000'000'000;
constexpr sender us{1, 191};

secret_key some_key() {
  std::array<std::byte, secret_key_size> bytes{};
  bytes.fill(std::byte{42});
  return secret_key(bytes);
}

frame_buffer position(signing sign) {
  return encode(global_position_int{.lat = 500'000'000, .hdg = 9000}, us, 0, sign);
}

// Making the frame included: a frame can be signed only once.
void sign(benchmark::State& state) {
  signer out(some_key(), link_id{0}, signing_time{0});
  for (auto _ : state) {
    auto frame = position(signing::on);
    benchmark::DoNotOptimize(out.sign(frame, some_day_ns));
    benchmark::DoNotOptimize(frame);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(sign)->Name("signing/encode_and_sign");

// A frame that is accepted the first time and a replay after that: the hash and the search of its stream are the same.
void verify(benchmark::State& state) {
  signer out(some_key(), link_id{0}, signing_time{0});
  auto frame = position(signing::on);
  if (!out.sign(frame, some_day_ns))
    state.SkipWithError("not signed");
  replay_table streams;
  verifier in(some_key(), streams);
  const signing_time now = signing_time_at(some_day_ns);
  for (auto _ : state)
    benchmark::DoNotOptimize(in.judge(frame.view(), now));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(verify)->Name("signing/verify");

void strip(benchmark::State& state) {
  signer out(some_key(), link_id{0}, signing_time{0});
  auto frame = position(signing::on);
  if (!out.sign(frame, some_day_ns))
    state.SkipWithError("not signed");
  unsigned_frame_bytes memory;
  for (auto _ : state)
    benchmark::DoNotOptimize(strip_signature(frame.view(), memory));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(strip)->Name("signing/strip");

} // namespace
} // namespace godwit::io::mavlink
