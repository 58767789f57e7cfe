// A vehicle with its lines and their links: frames from stations go through a line to the vehicle, and what it sends
// there goes through the line to all of them.
//
//   station ── link ── frame_finder ── faulty_line ── vehicle
//   station ── link ── frame_finder ───────────────── vehicle     each further line
//
// Faults are of the first line.
// Thread: that of the link, for all but the constructor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/link/link.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/scanner.hpp"
#include "programs/godwit-sim/host/fault.hpp"
#include "programs/godwit-sim/line/faulty_line.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::sim {

// Tells what a person cares about, out of everything that a vehicle does: armed, mode, in the air, mission, items,
// texts, battery, GPS; and which stations speak to it. A line for each, without its end.
//
// Pictures may come as often as one likes; a sentence comes when something has changed. Frames tell what a picture
// would miss between two looks. Pure. Thread: one at a time.
class event_watch {
public:
  static constexpr std::size_t max_stations = 16; // further ones are not told; so many peers a link has
  static constexpr double battery_step_percent = 10;

  // What has changed since the last picture; nothing for the first.
  [[nodiscard]] std::vector<std::string> look(const vehicle_picture& now);
  // What the vehicle sends: the sentence, or none.
  [[nodiscard]] std::string sent(const io::mavlink::frame_view& frame);
  // What a station sends: the sentence when it is a new one, or none.
  [[nodiscard]] std::string heard(const io::mavlink::frame_view& frame);

private:
  bool has_looked_ = false;
  vehicle_picture last_;
  int reached_ = -1; // the item told last: some autopilots repeat themselves
  std::vector<io::mavlink::sender> stations_;
};

// Finds the frames in what the stations of one vehicle send: whole datagrams, or streams that tear frames anywhere, a
// scanner for each.
//
// Datagrams leave nothing behind, so all vehicles can share the scanner for these. Streams are bounded: the one that
// was silent for longest is forgotten for a new one. Thread: one at a time.
class frame_finder {
public:
  static constexpr std::size_t max_streams = 16;          // as many peers as a link has
  static constexpr std::int64_t silence_ns = 250'000'000; // then no more bytes belong to the frame that waits for some
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  explicit frame_finder(io::mavlink::scanner& datagrams) : datagrams_(datagrams) {}

  template <class Sink>
  void feed(io::link::peer_id from, std::span<const std::byte> bytes, bool is_datagram, std::int64_t now_ns,
            Sink&& sink) {
    if (is_datagram) {
      datagrams_.feed_datagram(bytes, sink);
      return;
    }
    auto& stream = stream_of(from);
    stream.heard_ns = now_ns;
    stream.scanner->feed(bytes, sink);
  }

  // Ends what has waited too long.
  template <class Sink>
  void on_time(std::int64_t now_ns, Sink&& sink) {
    for (auto& each : streams_)
      if (each.scanner->waiting_bytes() != 0 && now_ns >= each.heard_ns + silence_ns)
        each.scanner->end_of_datagram(sink);
  }
  [[nodiscard]] std::int64_t next_deadline_ns() const;

  void forget(io::link::peer_id who);
  void forget_all() { streams_.clear(); }

private:
  struct torn_stream {
    io::link::peer_id from;
    std::int64_t heard_ns;
    std::unique_ptr<io::mavlink::scanner> scanner;
  };

  [[nodiscard]] torn_stream& stream_of(io::link::peer_id from);

  io::mavlink::scanner& datagrams_;
  std::vector<torn_stream> streams_;
};

struct hosted_settings {
  vehicle_settings vehicle;
  io::link::uri where;
  std::vector<io::link::uri> more_lines; // outlet::max_lines with the first one, at most
  line_faults faults;
  std::vector<fault::refuse> refusals;
};

class hosted_vehicle {
public:
  static constexpr std::int64_t look_ns = 100'000'000; // between two looks for what to tell

  // What all vehicles of a host share.
  struct surroundings {
    io::mavlink::scanner datagrams;
    io::mavlink::scanner damaged; // frames that the line has damaged: almost none is one any more
    std::function<std::int64_t()> now_ns;
    std::function<void(const hosted_vehicle& who, std::string sentence)> tell; // empty: nobody listens
    std::function<void(const io::mavlink::frame_view& frame)> record;          // empty: nothing is recorded
    std::function<void(bool is_cut)> cut_camera;                               // empty: there is none
    std::function<void(const hosted_vehicle& who)> moved;                      // its deadline has
    // One of its links has, that at WHERE.
    std::function<void(const hosted_vehicle& who, const io::link::uri& where, const io::link::link_status& now)>
        changed;
  };

  // NUMBER counts from 0. AROUND stays.
  hosted_vehicle(std::size_t number, const hosted_settings& settings, surroundings& around);
  hosted_vehicle(const hosted_vehicle&) = delete;
  hosted_vehicle& operator=(const hosted_vehicle&) = delete;

  [[nodiscard]] tl::expected<void, std::string> open(const io::link::link_options& options);
  // For the end: links are destroyed outside their thread. Nothing is sent any more.
  [[nodiscard]] std::vector<std::unique_ptr<io::link::link>> take_links();

  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const;
  void apply(const fault::any& what, std::int64_t now_ns);

  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] const hosted_settings& settings() const { return settings_; }
  [[nodiscard]] vehicle_picture describe() const { return vehicle_.describe(); }
  [[nodiscard]] const faulty_line& line() const { return line_; }
  [[nodiscard]] std::string link_description() const { return link_ ? link_->description() : settings_.where.text(); }
  [[nodiscard]] std::vector<std::string> more_link_descriptions() const;
  [[nodiscard]] io::link::link_counters link_counters() const {
    return link_ ? link_->counters() : io::link::link_counters{};
  }

private:
  struct apply_to;
  struct further_line {
    io::link::uri where;
    vehicle::line_number number = 0;
    frame_finder finder;
    std::unique_ptr<io::link::link> link;
  };

  using frame_sink = std::function<void(const io::mavlink::frame_view& frame)>;

  // FINDER and WHERE stay; TAKE gets each frame that comes.
  [[nodiscard]] io::link::link_callbacks callbacks(frame_finder& finder, const io::link::uri& where, frame_sink take);
  void add_line(const io::link::uri& where);
  void note_heard(const io::mavlink::frame_view& frame);
  void note_sent(const io::mavlink::frame_view& frame);
  void heard(const io::mavlink::frame_view& frame);
  void heard(const further_line& on, const io::mavlink::frame_view& frame);
  void arrived(way to, std::span<const std::byte> frame, bool is_damaged);
  void tell(std::string sentence);
  void look(std::int64_t now_ns);

  std::size_t number_;
  hosted_settings settings_;
  surroundings& around_;
  faulty_line line_;
  frame_finder finder_;
  event_watch watch_;
  std::int64_t next_look_ns_ = 0;
  vehicle vehicle_;
  std::unique_ptr<io::link::link> link_;
  std::vector<std::unique_ptr<further_line>> further_; // stay where they are: callbacks know them
};

} // namespace godwit::sim
