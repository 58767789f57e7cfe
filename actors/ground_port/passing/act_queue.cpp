#include "actors/ground_port/passing/act_queue.hpp"

#include <algorithm>
#include <utility>

namespace godwit::ground_port::passing {

namespace {

bool is_of_one_station(const waiting_act& a, const waiting_act& b) {
  return a.act.by == b.act.by && a.frame.message == b.frame.message;
}

// By the command and not by its bytes: a repetition counts its confirmation up.
bool repeats(const waiting_act& a, const waiting_act& b) {
  if (a.order && b.order)
    return is_of_one_station(a, b) && a.order->command == b.order->command && a.order->param1 == b.order->param1 &&
           a.order->param2 == b.order->param2 && a.order->param3 == b.order->param3;
  return a.frame == b.frame;
}

bool is_of_one_stream(const waiting_act& a, const waiting_act& b) {
  return a.act.kind == executor::act_kind::stream && b.act.kind == a.act.kind && is_of_one_station(a, b);
}

} // namespace

std::optional<std::uint64_t> act_queue::put(waiting_act what) {
  for (auto& each : waiting_) {
    if (repeats(each, what))
      return std::nullopt;
    if (is_of_one_stream(each, what)) {
      each.frame = std::move(what.frame);
      ++replaced_;
      return std::nullopt;
    }
  }
  if (waiting_.size() == max_waiting) {
    ++dropped_;
    return std::nullopt;
  }
  what.request = what.act.number = next_request_++;
  waiting_.push_back(std::move(what));
  return waiting_.back().request;
}

std::optional<waiting_act> act_queue::resolve(std::uint64_t request) {
  const auto found = std::ranges::find(waiting_, request, &waiting_act::request);
  if (found == waiting_.end())
    return std::nullopt;
  auto result = std::move(*found);
  waiting_.erase(found);
  return result;
}

} // namespace godwit::ground_port::passing
