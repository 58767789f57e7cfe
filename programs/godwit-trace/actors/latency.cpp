#include "programs/godwit-trace/actors/latency.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace godwit::trace_tool {

// Below `steps` each value has a bucket of its own; above, each doubling has `steps` of them.
std::size_t latency_histogram::bucket_of(std::uint64_t ns) {
  if (ns < steps)
    return static_cast<std::size_t>(ns);
  const auto doubling = static_cast<unsigned>(std::bit_width(ns)) - 1 - steps_log2;
  return static_cast<std::size_t>((std::uint64_t{doubling} + 1) * steps + ((ns >> doubling) - steps));
}

std::uint64_t latency_histogram::begin_of(std::size_t bucket) {
  if (bucket < steps)
    return bucket;
  const auto doubling = bucket / steps - 1;
  return (steps + bucket % steps) << doubling;
}

void latency_histogram::add(std::int64_t ns) {
  ns = std::max<std::int64_t>(ns, 0);
  const auto at = bucket_of(static_cast<std::uint64_t>(ns));
  if (buckets_.size() <= at)
    buckets_.resize(at + 1);
  ++buckets_[at];
  ++count_;
  max_ns_ = std::max(max_ns_, ns);
  total_ns_ += ns;
}

std::int64_t latency_histogram::quantile_ns(double part) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t at = 0; at < buckets_.size(); ++at) {
    seen += buckets_[at];
    if (seen >= wanted)
      return std::min(static_cast<std::int64_t>(begin_of(at + 1)) - 1, max_ns_);
  }
  return max_ns_;
}

std::vector<std::uint64_t> latency_histogram::by_doubling() const {
  std::vector<std::uint64_t> result;
  for (std::size_t at = 0; at < buckets_.size(); ++at) {
    const auto doubling = static_cast<std::size_t>(std::bit_width(std::max<std::uint64_t>(begin_of(at), 1))) - 1;
    if (result.size() <= doubling)
      result.resize(doubling + 1);
    result[doubling] += buckets_[at];
  }
  return result;
}

recent_handlers::slot& recent_handlers::slot_of(std::uint64_t id) {
  constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15; // spreads ids that follow each other (Fibonacci hashing)
  constexpr unsigned shift = 64 - 18;
  return slots_[static_cast<std::size_t>((id * golden) >> shift)];
}

std::optional<std::int64_t> recent_handlers::waiting_ns(const runtime::delivery& each) {
  std::optional<std::int64_t> result;
  const auto run = static_cast<std::uint32_t>(each.run);
  if (each.cause != 0 && each.sender != each.actor) {
    const auto& from = slot_of(each.cause);
    if (from.id == each.cause && from.run == run && from.actor == each.sender)
      result = std::max<std::int64_t>(each.began_ns - from.ended_ns, 0);
  }
  if (each.id != 0)
    slot_of(each.id) = {each.id, each.ended_ns(), each.actor, run};
  return result;
}

} // namespace godwit::trace_tool
