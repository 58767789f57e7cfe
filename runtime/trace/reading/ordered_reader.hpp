// The deliveries of a trace in the order in which their handlers began, run by run.
//
// The daemon's trace writer empties one ring after the other each 100 ms, so that what two threads did at the same time
// stands apart in the file. Deliveries are held back until what comes is WINDOW newer. Memory: max_held deliveries with
// their bodies; beyond that the older half goes out as it is. Thread: one at a time.
#pragma once

#include <memory>
#include <vector>

#include "runtime/trace/reading/trace_reader.hpp"

namespace godwit::runtime {

class ordered_reader {
public:
  static constexpr std::int64_t window_ns = 2'000'000'000; // a flood is rendered up to so much later
  static constexpr std::size_t max_held = std::size_t{1} << 17;
  static constexpr std::size_t max_held_bytes = std::size_t{48} << 20; // of bodies

  // FROM must live longer.
  explicit ordered_reader(trace_reader& from) : from_(from) {}

  // False: there are no more. The body is valid until the next call.
  [[nodiscard]] bool next(delivery& to);

private:
  // Text that stays where it is until all of it is given up.
  class arena {
  public:
    [[nodiscard]] std::string_view keep(std::string_view text);
    void clear();
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    static constexpr std::size_t block_bytes = std::size_t{1} << 20;
    struct block {
      std::unique_ptr<char[]> memory;
      std::size_t size = 0;
    };
    std::vector<block> blocks_;
    std::size_t block_ = 0; // that is being filled
    std::size_t used_ = 0;  // of it
    std::size_t bytes_ = 0;
  };

  [[nodiscard]] bool fill();
  void read_more();
  void choose_ready();

  trace_reader& from_;
  std::vector<delivery> held_; // sorted by time up to ready_end_
  std::size_t ready_ = 0;      // the next to give
  std::size_t ready_end_ = 0;
  arena bodies_;
  arena spare_;
  bool has_next_ = false; // the first delivery of another run
  delivery next_;
  std::string next_body_;
  bool is_at_end_ = false;
};

} // namespace godwit::runtime
