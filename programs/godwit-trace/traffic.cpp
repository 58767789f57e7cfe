#include "programs/godwit-trace/traffic.hpp"

#include <algorithm>
#include <tuple>

#include "io/mavlink/messages.hpp"
#include "programs/godwit-trace/message_name.hpp"

namespace godwit::trace_tool {

namespace {

std::uint64_t key_of(io::mavlink::sender from, std::uint32_t id) {
  return std::uint64_t{id} << 16U | std::uint64_t{from.system} << 8U | from.component;
}

} // namespace

void traffic::note(std::uint64_t time_us, const io::mavlink::frame_view& frame) {
  totals_.first_us = totals_.frames == 0 ? time_us : std::min(totals_.first_us, time_us);
  totals_.last_us = totals_.frames == 0 ? time_us : std::max(totals_.last_us, time_us);
  ++totals_.frames;
  totals_.known += io::mavlink::known_messages::contains(frame.id()) ? 1 : 0;
  totals_.signed_frames += frame.is_signed() ? 1 : 0;
  totals_.bytes += frame.size();
  auto row = rows_.find(key_of(frame.from(), frame.id()));
  if (row == rows_.end()) {
    if (rows_.size() == max_rows) {
      ++totals_.not_listed;
      return;
    }
    row = rows_.emplace(key_of(frame.from(), frame.id()), traffic_row{frame.from(), frame.id()}).first;
  }
  ++row->second.count;
  row->second.bytes += frame.size();
}

std::vector<traffic_row> traffic::rows() const {
  std::vector<traffic_row> result;
  result.reserve(rows_.size());
  for (const auto& each : rows_)
    result.push_back(each.second);
  std::ranges::sort(result, {}, [](const traffic_row& row) {
    return std::tuple(row.from.system, row.from.component, message_name(row.id));
  });
  return result;
}

std::optional<double> rate_hz(const traffic_row& row, const traffic_totals& totals) {
  const double duration_s = totals.duration_s();
  return duration_s > 0 ? std::optional(static_cast<double>(row.count) / duration_s) : std::nullopt;
}

} // namespace godwit::trace_tool
