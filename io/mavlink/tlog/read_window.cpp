#include "io/mavlink/tlog/read_window.hpp"

#include <cassert>
#include <cstring>

namespace godwit::io::mavlink {

mcap::result<void> read_window::require(std::size_t count) {
  assert(count <= window_bytes);
  if (end_ - begin_ >= count)
    return {};
  if (begin_ != 0 && begin_ != end_)
    std::memmove(memory_.data(), memory_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const auto got = source_->read_at(offset_ + end_, std::span(memory_).subspan(end_));
  if (!got)
    return tl::make_unexpected(got.error());
  end_ += *got;
  return {};
}

void read_window::drop(std::size_t count) {
  assert(count <= end_ - begin_);
  begin_ += count;
  offset_ += count;
}

} // namespace godwit::io::mavlink
