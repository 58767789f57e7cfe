#include "programs/godwit-sim/line/faulty_line.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::sim {

void faulty_line::restore() {
  cut(std::numeric_limits<std::int64_t>::min());
  for (auto& each : ways_)
    each.settings.is_cut = false;
}

void faulty_line::send(way to, std::span<const std::byte> frame, std::int64_t now_ns) {
  auto& line = of(to);
  ++line.counters.sent;
  if (!line.waiting.empty())
    deliver_due(to, now_ns); // what is due goes first, also when nobody has said so yet
  if (happens(line.settings.loss)) {
    ++line.counters.lost;
    return;
  }
  const bool twice = happens(line.settings.duplication);
  transmit(to, frame, now_ns);
  if (twice) {
    ++line.counters.duplicated;
    transmit(to, frame, now_ns);
  }
}

void faulty_line::transmit(way to, std::span<const std::byte> frame, std::int64_t now_ns) {
  auto& line = of(to);
  const auto due = due_ns(line, now_ns);
  if (due <= now_ns && line.settings.bit_errors == 0) {
    if (is_cut(to, now_ns))
      ++line.counters.cut;
    else
      hand_over(to, frame, false);
    return;
  }
  if (line.waiting.size() == max_waiting) {
    ++line.counters.overflowed;
    return;
  }
  under_way entry{due, ++line.numbered, false, {frame.begin(), frame.end()}};
  entry.is_damaged = damage(entry.frame, line.settings.bit_errors);
  line.counters.damaged += entry.is_damaged ? 1 : 0;
  line.waiting.push_back(std::move(entry));
  std::push_heap(line.waiting.begin(), line.waiting.end(), later);
  if (due <= now_ns)
    deliver_due(to, now_ns);
}

// When it comes: not before those that were sent before it, unless it is held back; then others overtake it.
std::int64_t faulty_line::due_ns(one_way& line, std::int64_t now_ns) {
  const auto jitter = static_cast<std::uint64_t>(line.settings.jitter.count());
  const auto extra = jitter == 0 ? 0 : static_cast<std::int64_t>(random_.below(jitter + 1));
  const auto due = std::max(now_ns + line.settings.delay.count() + extra, line.in_order_ns);
  if (happens(line.settings.late)) {
    ++line.counters.late;
    return due + late_hold_ns;
  }
  if (happens(line.settings.reorder)) {
    ++line.counters.reordered;
    return due + reorder_hold_ns;
  }
  line.in_order_ns = due;
  return due;
}

// The distance from one turned bit to the next is drawn, and not each bit: almost all bits are good.
bool faulty_line::damage(std::span<std::byte> frame, double bit_errors) {
  if (bit_errors <= 0)
    return false;
  const double bits = static_cast<double>(frame.size()) * 8;
  bool turned = false;
  for (double at = 0;; ++at) {
    at += bit_errors >= 1 ? 0 : std::floor(std::log1p(-random_.unit()) / std::log1p(-bit_errors));
    if (!(at < bits))
      return turned;
    const auto bit = static_cast<std::size_t>(at);
    frame[bit / 8] ^= std::byte{1} << (bit % 8);
    turned = true;
  }
}

void faulty_line::on_time(std::int64_t now_ns) {
  deliver_due(way::in, now_ns);
  deliver_due(way::out, now_ns);
}

// One way alone: who sends is in the middle of something, and must not be handed what comes the other way.
void faulty_line::deliver_due(way to, std::int64_t now_ns) {
  auto& waiting = of(to).waiting;
  while (!waiting.empty() && waiting.front().due_ns <= now_ns) {
    std::pop_heap(waiting.begin(), waiting.end(), later);
    const auto arrived = std::move(waiting.back());
    waiting.pop_back();
    if (is_cut(to, arrived.due_ns))
      ++of(to).counters.cut;
    else
      hand_over(to, arrived.frame, arrived.is_damaged);
  }
}

void faulty_line::hand_over(way to, std::span<const std::byte> frame, bool is_damaged) {
  ++of(to).counters.delivered;
  deliver_(to, frame, is_damaged);
}

std::int64_t faulty_line::next_deadline_ns() const {
  auto next = never;
  for (const auto& each : ways_)
    if (!each.waiting.empty())
      next = std::min(next, each.waiting.front().due_ns);
  return next;
}

bool faulty_line::later(const under_way& a, const under_way& b) {
  return a.due_ns != b.due_ns ? a.due_ns > b.due_ns : a.number > b.number;
}

} // namespace godwit::sim
