// What was heard, counted: for each sender and message how often and how large, and in total.
//
// Frames are counted as they are given; the caller has filtered them. What it did not give (broken records, refused
// frames) and what sequence numbers say is lost is the caller's to add in a `traffic_report`. Times are microseconds
// since 1970, UTC. Thread: a value.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/scanner.hpp"
#include "io/mavlink/signing/verifier.hpp"

namespace godwit::trace_tool {

struct traffic_row {
  io::mavlink::sender from;
  std::uint32_t id = 0;
  std::uint64_t count = 0;
  std::uint64_t bytes = 0; // of whole frames
};

struct traffic_totals {
  std::uint64_t frames = 0;
  std::uint64_t known = 0; // of messages that godwit decodes
  std::uint64_t signed_frames = 0;
  std::uint64_t bytes = 0;
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;
  std::uint64_t not_listed = 0; // frames for which there was no row left

  [[nodiscard]] std::uint64_t other() const { return frames - known; }
  [[nodiscard]] double duration_s() const { return static_cast<double>(last_us - first_us) / 1e6; }
};

class traffic {
public:
  // 32 senders with 128 kinds of messages each; a log that has more is made up.
  static constexpr std::size_t max_rows = 4'096;

  void note(std::uint64_t time_us, const io::mavlink::frame_view& frame);

  // Sorted by sender and name.
  [[nodiscard]] std::vector<traffic_row> rows() const;
  [[nodiscard]] const traffic_totals& totals() const { return totals_; }

private:
  std::unordered_map<std::uint64_t, traffic_row> rows_;
  traffic_totals totals_;
};

// How many there are of something that was not counted as a message.
struct skipped {
  std::string_view key;   // in JSON
  std::string_view words; // for people, before the number
  std::uint64_t count = 0;
};

struct traffic_report {
  const traffic& heard;
  std::vector<io::mavlink::sender_counters> senders; // losses and order, by sequence numbers
  std::vector<skipped> passed_over;
};

// Times a second over the whole of what was heard; none if that is less than two points in time.
[[nodiscard]] std::optional<double> rate_hz(const traffic_row& row, const traffic_totals& totals);

// For people: a table of messages, a table of senders, and sentences with the totals.
void append_table(std::string& out, const traffic_report& report);

// The same as one JSON object, without an end of line.
void append_traffic_json(std::string& out, const traffic_report& report);

// The sentence "passed over: ...: 3; ...: 1"; empty if nothing was.
[[nodiscard]] std::string passed_over_sentence(std::span<const skipped> list);

// Lets frames through whose signature is right, and says of the others why not: a sentence for the first of each
// cause, and their number at the end.
//
// Without a key everything passes, signed or not. The rules are those of io/mavlink/signing/verifier.hpp. Thread: one
// at a time.
class signature_check {
public:
  explicit signature_check(std::optional<io::mavlink::secret_key> key);

  // What became of FRAME, and what is to be said about it, if anything.
  struct answer {
    bool is_accepted = true;
    std::string sentence;
  };
  [[nodiscard]] answer judge(const io::mavlink::frame_view& frame, std::uint64_t time_us);

  // Refused frames by cause; without a key there are no causes.
  [[nodiscard]] std::vector<skipped> refused() const;

private:
  std::unique_ptr<io::mavlink::replay_table> streams_; // stays where it is: the verifier knows it by address
  io::mavlink::verifier verifier_;
};

} // namespace godwit::trace_tool
