#include "runtime/trace/reading/ordered_reader.hpp"

#include <algorithm>
#include <utility>

namespace godwit::runtime {

std::string_view ordered_reader::arena::keep(std::string_view text) {
  if (text.empty())
    return {};
  while (block_ < blocks_.size() && blocks_[block_].size - used_ < text.size()) {
    ++block_;
    used_ = 0;
  }
  if (block_ == blocks_.size()) {
    const auto size = std::max(block_bytes, text.size());
    blocks_.push_back({std::make_unique_for_overwrite<char[]>(size), size});
  }
  char* const at = blocks_[block_].memory.get() + used_;
  text.copy(at, text.size());
  used_ += text.size();
  bytes_ += text.size();
  return {at, text.size()};
}

void ordered_reader::arena::clear() {
  block_ = 0;
  used_ = 0;
  bytes_ = 0;
}

bool ordered_reader::next(delivery& to) {
  if (ready_ == ready_end_ && !fill())
    return false;
  to = held_[ready_++];
  return true;
}

// What was given is forgotten, more is read, and what is certain to be in order becomes ready.
bool ordered_reader::fill() {
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(ready_end_));
  ready_ = 0;
  ready_end_ = 0;
  spare_.clear();
  for (auto& each : held_)
    each.body = spare_.keep(each.body);
  std::swap(spare_, bodies_);
  while (ready_end_ == 0) {
    read_more();
    if (held_.empty() && is_at_end_ && !has_next_)
      return false;
    choose_ready();
  }
  return true;
}

void ordered_reader::read_more() {
  constexpr std::size_t step = max_held / 4;
  const auto add = [this](delivery each) {
    each.body = bodies_.keep(each.body);
    held_.push_back(each);
  };
  if (held_.empty() && has_next_) {
    has_next_ = false;
    add(next_);
  }
  delivery each;
  for (std::size_t n = 0; n < step && !has_next_ && !is_at_end_ && bodies_.bytes() < max_held_bytes; ++n) {
    if (!from_.next(each)) {
      is_at_end_ = true;
    } else if (!held_.empty() && each.run != held_.front().run) {
      has_next_ = true;
      next_body_ = each.body;
      next_ = each;
      next_.body = next_body_;
    } else {
      add(each);
    }
  }
}

void ordered_reader::choose_ready() {
  const auto by_time = [](const delivery& a, const delivery& b) { return a.began_ns < b.began_ns; };
  if (!std::ranges::is_sorted(held_, by_time))
    std::ranges::stable_sort(held_, by_time);
  ready_ = 0;
  if (is_at_end_ || has_next_) {
    ready_end_ = held_.size();
    return;
  }
  const auto sure_until_ns = held_.back().began_ns - window_ns;
  const auto sure = std::ranges::upper_bound(held_, sure_until_ns, {}, &delivery::began_ns);
  ready_end_ = static_cast<std::size_t>(sure - held_.begin());
  if (ready_end_ == 0 && (held_.size() >= max_held || bodies_.bytes() >= max_held_bytes))
    ready_end_ = std::max<std::size_t>(held_.size() / 2, 1);
}

} // namespace godwit::runtime
