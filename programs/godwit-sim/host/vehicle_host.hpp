// Runs vehicles in real time, each on links of its own, all in one thread: it sleeps until a frame comes or the next
// of them is due.
//
//   auto host = vehicle_host::open(settings, [](std::string_view line) { ... });
//   (*host)->wait();                 // until the control port or a signal ends it
//
// Vehicles are woken at their deadlines, at most once in `turn_ns`. Errors: open fails with a sentence when a link or
// the control port can not work, or when what has to listen can not. Thread: open, wait and the end by the owner; the
// teller is called in the host's own thread, where `inside` runs things, too.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <tl/expected.hpp>

#include "io/link/io_thread.hpp"
#include "io/mavlink/tlog/tlog_writer.hpp"
#include "programs/godwit-sim/camera_server/camera_place.hpp"
#include "programs/godwit-sim/host/control_port.hpp"
#include "programs/godwit-sim/host/hosted_vehicle.hpp"

namespace godwit::sim {

// Real time as the vehicles see it: nanoseconds since 1970 when the program started, and from then on as the steady
// clock goes, so that nobody's setting of the wall clock moves a vehicle. Thread: any.
class host_clock {
public:
  using steady = std::chrono::steady_clock;

  [[nodiscard]] std::int64_t now_ns() const { return steady::now().time_since_epoch().count() + offset_ns_; }
  [[nodiscard]] steady::time_point at(std::int64_t ns) const {
    return steady::time_point(std::chrono::nanoseconds(ns - offset_ns_));
  }

private:
  static_assert(std::is_same_v<steady::duration, std::chrono::nanoseconds>);
  std::int64_t offset_ns_ =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count() -
      steady::now().time_since_epoch().count();
};

// Who is due next, of a fixed number of members that each have one deadline which moves all the time.
//
// A binary heap that knows where each member stands, so that moving a deadline costs a few steps and leaves nothing
// behind. Thread: one at a time. Source: any textbook (indexed priority queue).
class deadline_heap {
public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  // All are due never. At least one member.
  explicit deadline_heap(std::size_t members) : deadlines_(members, never), order_(members), places_(members) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::iota(places_.begin(), places_.end(), std::size_t{0});
  }

  void set(std::size_t member, std::int64_t deadline) {
    deadlines_[member] = deadline;
    sink(rise(places_[member]));
  }
  [[nodiscard]] std::size_t first() const { return order_.front(); }
  [[nodiscard]] std::int64_t first_deadline() const { return deadlines_[order_.front()]; }

private:
  [[nodiscard]] std::int64_t at(std::size_t place) const { return deadlines_[order_[place]]; }
  void exchange(std::size_t a, std::size_t b) {
    std::swap(order_[a], order_[b]);
    places_[order_[a]] = a;
    places_[order_[b]] = b;
  }
  std::size_t rise(std::size_t place) {
    while (place > 0 && at(place) < at((place - 1) / 2)) {
      exchange(place, (place - 1) / 2);
      place = (place - 1) / 2;
    }
    return place;
  }
  void sink(std::size_t place) {
    for (;;) {
      auto least = place;
      for (const auto child : {2 * place + 1, 2 * place + 2})
        if (child < order_.size() && at(child) < at(least))
          least = child;
      if (least == place)
        return;
      exchange(place, least);
      place = least;
    }
  }

  std::vector<std::int64_t> deadlines_; // by member
  std::vector<std::size_t> order_;      // the heap: members
  std::vector<std::size_t> places_;     // by member: where it stands in the heap
};

struct host_settings {
  std::vector<hosted_settings> vehicles; // at least one
  std::vector<timed_fault> faults;       // of all vehicles
  std::optional<io::link::uri> control;  // tcp_in, on a loopback address
  std::optional<camera_place> camera;    // of the first vehicle
  std::string camera_truth;              // what is to be seen goes into this file if not empty
  std::string tlog;                      // records into this file if not empty
  bool ends_on_signals = false;          // SIGINT and SIGTERM
  bool is_quiet = false;                 // tells nothing but failures
};

class vehicle_host {
public:
  using teller = std::function<void(std::string_view line)>;

  // No vehicle is woken more often: a thousand that are due one after the other share a turn.
  static constexpr std::int64_t turn_ns = 1'000'000;
  static constexpr std::uint64_t tlog_bytes = std::uint64_t{1} << 30; // then a new file is begun
  static constexpr unsigned tlog_older_files = 3;

  [[nodiscard]] static tl::expected<std::unique_ptr<vehicle_host>, std::string> open(host_settings settings,
                                                                                     teller tell);
  ~vehicle_host();
  vehicle_host(const vehicle_host&) = delete;
  vehicle_host& operator=(const vehicle_host&) = delete;

  // Until end(), a signal, or `quit` on the control port.
  void wait() { ended_.get_future().wait(); }
  // Runs WHAT in the host's thread, and waits for it.
  void inside(const std::function<void()>& what) { thread_->run_inside(what); }
  // With port numbers as they are; of the control port empty if there is none.
  [[nodiscard]] std::vector<std::string> links(); // the first of each vehicle
  [[nodiscard]] std::vector<std::string> more_links(std::size_t number);
  [[nodiscard]] std::string control();

  // -- inside only
  void end();
  [[nodiscard]] std::size_t size() const { return vehicles_.size(); }
  [[nodiscard]] const hosted_vehicle& at(std::size_t number) const { return *vehicles_[number]; }
  void set_camera(std::function<void(bool is_cut)> cut) { around_.cut_camera = std::move(cut); }
  // To the vehicle with this number, or to all.
  void apply(const fault::any& what, std::optional<std::size_t> number);

private:
  vehicle_host(host_settings settings, teller tell);

  [[nodiscard]] tl::expected<void, std::string> start();
  void open_links();
  void link_changed(const hosted_vehicle& who, const io::link::uri& where, const io::link::link_status& status);
  void answered(const std::string& failure);
  void tell(const hosted_vehicle& who, const std::string& sentence);
  [[nodiscard]] tl::expected<void, std::string> open_record();
  void record(const io::mavlink::frame_view& frame);
  void arm();
  void turn();
  void run_due_faults(std::int64_t now_ns);
  void flush_record(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_ns() const;

  host_settings settings_;
  teller teller_;
  host_clock clock_;
  std::int64_t began_ns_ = 0;
  std::shared_ptr<io::link::io_thread> thread_;
  hosted_vehicle::surroundings around_;
  std::vector<std::unique_ptr<hosted_vehicle>> vehicles_;
  deadline_heap due_;
  std::unique_ptr<control_port> control_;
  io::mavlink::tlog_writer tlog_;
  bool tlog_failed_ = false;
  std::int64_t next_flush_ns_ = 0;

  boost::asio::steady_timer timer_;
  boost::asio::signal_set signals_;
  std::int64_t armed_ns_ = deadline_heap::never;
  std::int64_t last_turn_ns_ = 0;
  std::size_t next_fault_ = 0;
  bool is_over_ = false;

  std::size_t listeners_ = 0;           // that have not said yet whether they listen
  std::promise<std::string> listening_; // the failure, or nothing
  bool has_answered_ = false;
  std::promise<void> ended_;
};

} // namespace godwit::sim
