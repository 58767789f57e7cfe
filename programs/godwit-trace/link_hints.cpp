#include "programs/godwit-trace/link_hints.hpp"

#include "programs/common/link_advice.hpp"

namespace godwit::trace_tool {

std::optional<std::string> link_hints::due(std::chrono::milliseconds elapsed, const io::mavlink::scan_counters& heard) {
  if (heard.frames != 0)
    return std::nullopt;
  if (!told_v1_ && elapsed >= v1_after && heard.v1_frames >= v1_frames_enough) {
    told_v1_ = true;
    told_silence_ = true;
    return std::string("only MAVLink 1 is heard, which is not shown. ") + programs::advice_for_mavlink_1;
  }
  if (told_silence_ || elapsed < silent_after || heard.v1_frames != 0)
    return std::nullopt;
  told_silence_ = true;
  return heard.bytes == 0 ? programs::advice_for_silence(where_, silent_after, has_heartbeat_)
                          : programs::advice_for_noise(where_, heard.bytes);
}

} // namespace godwit::trace_tool
