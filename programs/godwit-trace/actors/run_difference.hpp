// Where two runs part: the first message that one took and the other did not, and why.
//
// Compared is what each actor took from each sender, in its order: type, how it ended, and the message; neither times
// nor ids, nor how the messages of different senders are mixed. Of all places where that differs the oldest counts, and
// from there its causes are followed back as long as they differ too: what comes later is a symptom. Memory: 48 bytes a
// message. Thread: one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::trace_tool {

// One run, as it is compared.
class compared_run {
public:
  // Fields of messages that are not compared, at any depth.
  explicit compared_run(std::vector<std::string> ignored) : ignored_(std::move(ignored)) {}

  // In the order of time, of one run.
  void add(const runtime::delivery& each, const runtime::name_table& names);

  struct entry {
    std::uint64_t content = 0; // hash of what is compared
    std::uint64_t id = 0;
    std::uint64_t cause = 0;
    std::int64_t since_ns = 0; // since the first delivery of the run
    std::uint64_t number = 0;  // of the delivery in the run, from 0 on
    bool operator==(const entry& other) const { return content == other.content; }
  };
  struct stream {
    std::string name; // "executor <- failsafe"
    std::vector<entry> entries;
  };
  [[nodiscard]] const std::vector<stream>& streams() const { return streams_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

private:
  [[nodiscard]] std::uint64_t hash_of(std::string_view body) const;
  [[nodiscard]] stream& stream_of(const runtime::delivery& each, const runtime::name_table& names);

  std::vector<std::string> ignored_;
  std::vector<stream> streams_;
  std::unordered_map<std::uint64_t, std::size_t> places_; // by actor and sender
  std::vector<std::uint64_t> type_hashes_;                // by the number of the name
  std::uint64_t count_ = 0;
  std::int64_t begin_ns_ = 0;
};

struct difference {
  std::string stream;
  std::uint64_t index = 0;               // in the stream, from 0 on
  std::optional<std::uint64_t> a_number; // of the delivery in run A; absent: A has no more in this stream
  std::optional<std::uint64_t> b_number;
  std::vector<std::uint64_t> a_symptoms; // numbers of later differing deliveries that led back to it, newest first
  std::size_t streams_that_differ = 0;
};

[[nodiscard]] std::optional<difference> first_difference(const compared_run& a, const compared_run& b);

} // namespace godwit::trace_tool
