// Sees to it that the vehicle sends what we need, as often as we need it.
//
// For each wanted message:
//
//   unasked ──SET_MESSAGE_INTERVAL──> asked ──answer──> watched ──comes often enough──> (watched, again and again)
//      ^                                                   │
//      └────────────────does not come; tries left──────────┤
//                                                          └──no tries left──> REQUEST_DATA_STREAM, once ──> watched
//
// What counts is what comes, not what was answered: PX4 refuses an interval for MISSION_CURRENT and sends it all the
// same. One request is under way at a time, since two with the same command id could not be told apart. A message that
// never comes (a rover has no EXTENDED_SYS_STATE) is named in `missing`, and asked for again at long intervals. One
// that is optional is not named, and not asked for by the older request, which can mean all streams at once. Of one
// that is occasional the answer counts. Pure: time comes in as monotonic nanoseconds. Source: MAVLink, "Message
// intervals and streams".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::vehicle_link {

struct wanted_stream {
  std::uint32_t message = 0; // id
  std::int32_t interval_ms = 1'000;
  std::optional<io::mavlink::mav_autopilot> only_of = {}; // what no other autopilot has is not asked for
  bool is_optional = false;   // whose absence is no fault: older versions of that autopilot do not know it
  bool is_occasional = false; // comes when there is something to report: it is asked for until that is answered
};

inline constexpr std::size_t max_wanted_streams = 32;
inline constexpr int stream_tries = 3;                      // of SET_MESSAGE_INTERVAL, before the older request
inline constexpr std::int64_t stream_window_min_ms = 3'000; // what comes is counted over at least so long
inline constexpr std::int64_t stream_retry_ms = 60'000;     // for what does not come after all
inline constexpr std::int32_t close_heartbeat_ms = 200;     // a person who acts is seen within this
inline constexpr std::int32_t usual_heartbeat_ms = 1'000;   // of all autopilots

class stream_keeper {
public:
  // At most max_wanted_streams; what is beyond is not asked for.
  explicit stream_keeper(std::vector<wanted_stream> wanted);

  // The vehicle is there, or has started again: ask for all that it has.
  void begin(std::int64_t now_ns, std::optional<io::mavlink::mav_autopilot> whose = {});
  void end(); // it is gone
  // Five a second, or one again. A vehicle that can not (PX4) goes on with one a second.
  void want_heartbeats(bool is_close, std::int64_t now_ns);
  void on_message(std::uint32_t id);
  void on_outcome(const command_outcome& outcome, std::int64_t now_ns);

  // What to send now; target fields are the caller's business. Call again until there is nothing.
  using request = std::variant<send_command, io::mavlink::request_data_stream>;
  [[nodiscard]] std::optional<request> next_request(std::int64_t now_ns);
  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const;
  [[nodiscard]] std::vector<std::uint32_t> missing() const; // ids that do not come

private:
  enum class step { idle, unasked, asked, watched };
  struct stream {
    wanted_stream wanted;
    step at = step::idle;
    int tries = 0;
    bool fell_back = false;
    bool is_missing = false;
    std::uint64_t arrived = 0;    // in this window
    std::int64_t due_ns = 0;      // when to act: to ask (unasked), to judge (watched)
    std::int64_t window_from = 0; // ns
  };

  void judge(stream& s, std::int64_t now_ns);
  void watch(stream& s, std::int64_t now_ns);
  [[nodiscard]] stream* asked();
  [[nodiscard]] request request_for(stream& s);

  std::vector<stream> streams_;
  bool is_begun_ = false; // the vehicle is there
};

} // namespace godwit::vehicle_link
