// Reads the deliveries out of trace files, one after the other, as they stand in the files: nearly in the order of
// time (ordered_reader.hpp brings them into it).
//
// A file that is cut or damaged is read as far as it can be, and what could not be read is in losses(). A file all of
// whose messages lie outside of the wanted time is not read, only its summary. Memory: a few MiB, whatever the size.
// Errors: none; a file that can not be opened is a loss. Thread: one at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/mcap/file_summary.hpp"
#include "io/mcap/salvage_reader.hpp"
#include "runtime/trace/reading/delivery.hpp"
#include "runtime/trace/reading/record_parser.hpp"
#include "runtime/trace/reading/trace_files.hpp"

namespace godwit::runtime {

struct time_span_ns {
  std::int64_t from_ns = INT64_MIN; // included
  std::int64_t to_ns = INT64_MAX;   // not included
  [[nodiscard]] bool contains(std::int64_t at_ns) const { return at_ns >= from_ns && at_ns < to_ns; }
};

struct read_counts {
  std::uint64_t files = 0;         // that were read
  std::uint64_t files_skipped = 0; // because of the time
  std::uint64_t bytes = 0;         // of the files read
  std::uint64_t deliveries = 0;
};

class trace_reader {
public:
  using string_map = std::map<std::string, std::string>;
  static constexpr std::size_t max_losses = 10'000; // kept one by one; further ones are only counted

  // NAMES must live longer.
  trace_reader(std::vector<trace_file> files, name_table& names, time_span_ns wanted = {});

  // False: there are no more. Views in TO are valid until the next call.
  [[nodiscard]] bool next(delivery& to);

  // For a trace that is being written: next() gives false where nothing more stands now, and may be called again later.
  // LIST gives all files that there are then. Before the first next().
  void follow(std::function<std::vector<trace_file>()> list) { list_ = std::move(list); }

  [[nodiscard]] const std::vector<loss>& losses() const { return losses_; }
  [[nodiscard]] std::uint64_t losses_not_kept() const { return losses_not_kept_; }
  [[nodiscard]] const read_counts& counts() const { return counts_; }
  [[nodiscard]] const std::vector<trace_file>& files() const { return files_; }
  // What the files that were read say of RUN itself, such as its settings; empty: nothing.
  [[nodiscard]] const string_map& about(std::uint64_t run) const;
  // Called with the bytes that are done and those that there are, at each file and each few MiB.
  void on_progress(std::function<void(std::uint64_t, std::uint64_t)> call) { progress_ = std::move(call); }

private:
  struct channel {
    bool is_known = false;
    std::uint32_t actor = 0;
    std::uint32_t type = 0;
    std::uint32_t sender = 0; // of the last message
  };

  [[nodiscard]] bool open_next();
  void look_for_files();
  [[nodiscard]] bool go_on();
  [[nodiscard]] bool is_wanted(const io::mcap::file_summary& summary) const;
  void begin_run(const trace_file& file);
  void define(io::mcap::channel_id id, std::string_view topic);
  [[nodiscard]] bool take(const io::mcap::message_record& message, delivery& to);
  void take(const io::mcap::metadata_record& metadata);
  void take(const io::mcap::unreadable& lost);
  void note_trace_loss(std::string_view body);
  [[nodiscard]] std::uint32_t number_of(std::string_view name, std::uint32_t& guess);
  void note(loss what);
  void end_file();

  std::vector<trace_file> files_;
  name_table& names_;
  time_span_ns wanted_;
  record_parser parser_;
  std::size_t next_file_ = 0;
  std::unique_ptr<io::mcap::file_source> source_;
  std::optional<io::mcap::salvage_reader> reader_;
  std::vector<channel> channels_; // by id
  std::uint64_t run_ = 0;
  std::uint64_t number_ = 0; // of the last segment of this run
  std::int64_t newest_ns_ = 0;
  std::uint64_t dropped_ = 0; // as last told in this run
  std::uint64_t unwritten_ = 0;
  std::uint64_t unknown_ = 0; // in this file
  std::uint32_t trace_loss_type_ = 0;
  std::uint64_t total_bytes_ = 0;
  std::uint64_t done_bytes_ = 0;
  std::vector<loss> losses_;
  std::map<std::uint64_t, string_map> about_; // by run
  std::uint64_t losses_not_kept_ = 0;
  read_counts counts_;
  std::function<void(std::uint64_t, std::uint64_t)> progress_;
  std::function<std::vector<trace_file>()> list_; // empty: the trace is not followed
  std::optional<std::uint64_t> resume_at_;        // offset in the open file, of which no more is there yet
};

} // namespace godwit::runtime
