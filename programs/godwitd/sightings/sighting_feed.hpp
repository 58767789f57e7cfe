// Sightings from a file or from standard input, handed out one by one and kept until they are resolved.
//
//   file ──thread──> [waiting] ──take──> [given] ──resolve──> gone
//                        ^                  │
//                        └─── take_back ────┘   who took them has died
//
// A thread of its own reads ahead, up to a bound, and wakes whoever takes when there is something after nothing was
// there, and at the end. It outlives the incarnations of that actor. Errors: open, as a sentence; a line that is no
// sighting is passed over, counted and reported by number. Thread: open, start, stop by the owner; the rest from any.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "programs/godwitd/sightings/messages.hpp"

namespace godwit::daemon {

class sighting_feed {
public:
  static constexpr std::size_t max_waiting = 1'000;

  using waker = std::function<void()>;
  // Hears what is wrong with a line. Called in the feed's thread.
  using complainer = std::function<void(const std::string& sentence)>;

  struct numbered {
    std::uint64_t number = 0;
    mapobjects_store::sighting seen;
  };

  // FILE "-": standard input.
  [[nodiscard]] static tl::expected<std::shared_ptr<sighting_feed>, std::string> open(const std::string& file,
                                                                                      const std::string& mission_id);
  // Of what a program adds itself; it has no thread, and nobody is woken.
  [[nodiscard]] static std::shared_ptr<sighting_feed> without_file();
  ~sighting_feed();
  sighting_feed(const sighting_feed&) = delete;
  sighting_feed& operator=(const sighting_feed&) = delete;

  void start(waker wake, complainer complain); // once
  void stop();                                 // WAKE is not called any more
  // False: there is no room.
  [[nodiscard]] bool add(mapobjects_store::sighting seen);

  // Closed at first, and while it is nothing is handed out to who asks whether it is open.
  void set_gate(bool open) { is_gate_open_.store(open); }
  [[nodiscard]] bool is_gate_open() const { return is_gate_open_.load(); }

  // Nothing: come again when woken.
  [[nodiscard]] std::optional<numbered> take();
  void resolve(std::uint64_t number, bool is_recorded);
  void take_back(std::uint64_t number);
  void count_not_offered();
  void count_without_room();
  void take_back_all();

  // Nothing is left, and nothing will come.
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] sighting_counts counts() const;

private:
  sighting_feed(std::string name, std::string mission_id, io::link::descriptor file, io::link::descriptor stop);

  void run();
  [[nodiscard]] bool wait_readable() const;
  void read_lines(std::string_view bytes);
  void end_line();
  void pass_over(const std::string& why);
  void put(mapobjects_store::sighting seen);
  void end();

  const std::string name_;
  const std::string mission_id_;
  io::link::descriptor file_;
  io::link::descriptor stop_; // readable: end
  waker wake_;
  complainer complain_;

  // Of the thread.
  std::string line_; // what has come of it
  bool is_too_long_ = false;
  std::uint64_t line_number_ = 1;

  std::atomic<bool> is_gate_open_{false};
  mutable std::mutex mutex_;
  std::condition_variable room_;
  std::deque<numbered> waiting_;
  std::map<std::uint64_t, mapobjects_store::sighting> given_;
  std::uint64_t last_number_ = 0;
  sighting_counts counts_;
  bool is_awake_ = false; // whoever takes knows that there is something
  bool has_ended_ = false;
  bool is_stopping_ = false;
  std::thread thread_;
};

// One sighting as a line of text:
//
//   {"id": "9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d", "class_group": "vehicle", "latitude": 47.39895,
//   "longitude": 8.54722,
//    "altitude_m": 441.5, "confidence": 0.9, "at": "2026-05-04T10:15:44Z"}
//
// All but altitude_m (above mean sea level) has to be there, and nothing else may be. The id makes a line that is read
// again the same sighting. Errors: a sentence. Thread: pure.
inline constexpr std::size_t max_sighting_bytes = 4 * 1024; // a line has about 200

[[nodiscard]] tl::expected<mapobjects_store::sighting, std::string> read_sighting(std::string_view line,
                                                                                  const std::string& mission_id);

} // namespace godwit::daemon
