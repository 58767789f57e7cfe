// The segments of a recording in one folder: <prefix>-<run>-<number>.mcap (or another ending), run and number with
// leading zeros, so that names sort as the segments were made. Bounds what they take together by deleting the oldest.
//
// Only files of exactly such names are counted, completed and deleted. One process at a time works on a folder.
// Sizes in bytes. Errors: io, invalid_argument, too_many. Thread: one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/mcap/error.hpp"
#include "io/mcap/format.hpp"
#include "io/mcap/repair.hpp"

namespace godwit::io::mcap {

struct segment_folder_options {
  std::filesystem::path folder;  // made when it is missing; else it belongs to who runs this process
  std::string prefix = "godwit"; // letters, digits, '_'
  std::uint64_t segment_bytes = max_segment_bytes;
  std::uint64_t total_bytes = std::uint64_t{256} << 20; // at least two segments
  std::string extension = ".mcap";
};

struct segment {
  std::filesystem::path path;
  std::uint64_t run = 0;
  std::uint64_t number = 0;
  std::uint64_t size_bytes = 0;
};

struct segment_completion {
  std::filesystem::path path;
  result<completion> outcome;
};

class segment_folder {
public:
  static constexpr std::uint64_t min_segment_bytes = std::uint64_t{16} << 10;
  static constexpr std::uint64_t max_run = 9'999'999'999; // ten digits: a counter, or seconds of the Unix epoch
  static constexpr std::uint64_t max_number = 999'999;

  // Checks the options, makes the folder and lists what is in it.
  [[nodiscard]] result<void> open(segment_folder_options options);
  // It may have been removed: makes it again, and forgets the segments that are gone. Names go on where they were.
  [[nodiscard]] result<void> renew();

  // MCAP only. Completes every segment whose end is missing. For the start, before anything is written; one damaged
  // segment does not keep the others from being completed.
  [[nodiscard]] std::vector<segment_completion> complete_all();

  // Deletes the oldest segments until one more of segment_bytes fits into total_bytes, and gives the name for it. The
  // segment is on the list from now on, counted with its full size until note_size().
  [[nodiscard]] result<std::filesystem::path> add(std::uint64_t run);
  // The newest segment has got its final size.
  void note_size(std::uint64_t size_bytes);
  // Deletes the newest segment, in which nothing was written.
  [[nodiscard]] result<void> remove_newest();

  [[nodiscard]] const std::vector<segment>& segments() const { return segments_; } // oldest first
  [[nodiscard]] std::uint64_t total_bytes() const;
  [[nodiscard]] std::uint64_t segments_deleted() const { return segments_deleted_; }
  [[nodiscard]] const segment_folder_options& options() const { return options_; }

private:
  [[nodiscard]] result<void> check_options() const;
  [[nodiscard]] result<void> provide() const;
  [[nodiscard]] result<void> list();
  [[nodiscard]] result<void> make_room();
  [[nodiscard]] result<void> remove(std::vector<segment>::iterator which);

  segment_folder_options options_;
  std::vector<segment> segments_;
  std::uint64_t last_run_ = 0; // of the newest name that was given
  std::uint64_t last_number_ = 0;
  std::uint64_t segments_deleted_ = 0;
};

} // namespace godwit::io::mcap
