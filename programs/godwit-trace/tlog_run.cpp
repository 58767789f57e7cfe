#include "programs/godwit-trace/tlog_run.hpp"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "programs/godwit-trace/traffic.hpp"

namespace godwit::trace_tool {

namespace {

namespace fs = std::filesystem;
namespace mavlink = io::mavlink;

constexpr std::uint64_t v1_frames_enough = 2; // one could be chance

// What is wrong with FILE before it is opened; empty if nothing is.
std::string what_is_wrong_with(const std::string& file) {
  std::error_code code;
  const auto kind = fs::status(file, code).type();
  switch (kind) {
  case fs::file_type::not_found:
    return "no such file";
  case fs::file_type::directory:
    return "it is a folder, not a file";
  case fs::file_type::regular:
    return fs::is_empty(file, code) && !code ? "it is empty" : "";
  case fs::file_type::none:
  case fs::file_type::unknown:
    return code.message();
  default:
    return "it is not a file on a disk, and a log is not read from anything else; save it first";
  }
}

std::vector<skipped> passed_over(const mavlink::tlog_counts& counts) {
  return {{"bad_checksums", "frames with a wrong checksum (CRC)", counts.bad_checksums},
          {"cut_off", "records that were cut off", counts.cut_off},
          {"not_frames", "records that hold no frame", counts.not_frames},
          {"unknown_flags", "frames with flags that nobody knows", counts.unknown_flags},
          {"v1_frames", "frames of MAVLink 1", counts.v1_frames},
          {"skipped_bytes", "bytes that belong to no record", counts.skipped_bytes}};
}

// One pass through a log.
class tlog_run {
public:
  tlog_run(const tlog_options& options, console& to)
      : options_(options), to_(to), printer_(options.print.form, options.time) {}

  void take(const mavlink::tlog_record& record) {
    if (!begin_us_) {
      begin_us_ = record.timestamp_us;
      printer_.begin_at(record.timestamp_us);
    }
    const auto& filter = options_.print.filter;
    if (!options_.range.contains(record.timestamp_us, *begin_us_) || !filter.wants_sender(record.frame.from()))
      return;
    if (record.is_verified)
      senders_.note(record.frame.from(), record.frame.sequence());
    else
      senders_.note_unverified(record.frame.from(), record.frame.sequence());
    if (!filter.wants(record.frame))
      return;
    if (options_.print.stats)
      heard_.note(record.timestamp_us, record.frame);
    else
      printer_.append(to_.out.text(), record.timestamp_us, record.frame);
  }

  void finish(const mavlink::tlog_counts& counts) {
    auto lost = passed_over(counts);
    if (!options_.print.stats) {
      to_.out.flush();
      if (const auto sentence = passed_over_sentence(lost); !sentence.empty())
        to_.say(options_.file + ": " + sentence);
      return;
    }
    const traffic_report report{heard_, {senders_.all().begin(), senders_.all().end()}, std::move(lost)};
    if (options_.print.form == print_form::json) {
      append_traffic_json(to_.out.text(), report);
      to_.out.text() += '\n';
    } else {
      append_table(to_.out.text(), report);
    }
    to_.out.flush();
  }

private:
  const tlog_options& options_;
  console& to_;
  message_printer printer_;
  traffic heard_;
  mavlink::sender_table senders_;
  std::optional<std::uint64_t> begin_us_;
};

exit_code fail(console& to, const std::string& file, const std::string& what) {
  to.out.flush();
  to.say(file + ": " + what);
  return exit_code::failed;
}

exit_code finish(tlog_run& run, const tlog_options& options, console& to, const mavlink::tlog_counts& counts,
                 std::uint64_t size_bytes) {
  if (counts.frames == 0)
    return fail(to, options.file,
                "this is no .tlog: there is not one MAVLink 2 frame with a right checksum in " +
                    std::to_string(size_bytes) + " bytes" +
                    (counts.v1_frames < v1_frames_enough ? "" : ", only MAVLink 1, which is not read"));
  run.finish(counts);
  if (counts.frames == counts.without_time)
    to.say(options.file + ": no frame has a time before it; these may be the bytes of a link and not a .tlog");
  return exit_code::ok;
}

} // namespace

exit_code run_tlog(const tlog_options& options, console& to) {
  if (const auto wrong = what_is_wrong_with(options.file); !wrong.empty())
    return fail(to, options.file, wrong);
  io::mcap::file_source source;
  if (const auto opened = source.open(options.file); !opened)
    return fail(to, options.file, opened.error().what);
  mavlink::tlog_reader reader(source);
  tlog_run run(options, to);
  while (to.out.flush_if_full()) {
    const auto record = reader.next();
    if (!record)
      return fail(to, options.file, record.error().what);
    if (!*record)
      return finish(run, options, to, reader.counts(), source.size_bytes());
    run.take(**record);
  }
  return exit_code::ok; // the reader of the output has gone away; a full disk is told at the end of the program
}

tl::expected<void, std::string> tlog_recording::open(const std::string& file) {
  std::error_code ignored;
  const auto folder = fs::path(file).parent_path();
  if (fs::is_directory(file, ignored))
    return tl::make_unexpected(file + ": it is a folder, not a file");
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    return tl::make_unexpected(file + ": there is no folder " + folder.string());
  const auto opened = writer_.open({.file = file, .file_bytes = file_bytes, .older_files = older_files});
  if (!opened)
    return tl::make_unexpected(opened.error().message());
  file_ = file;
  return {};
}

std::string tlog_recording::write(std::uint64_t time_us, const io::mavlink::frame_view& frame) {
  return file_.empty() ? std::string() : once(writer_.write(time_us, frame));
}

std::string tlog_recording::flush() { return once(writer_.flush()); }

std::string tlog_recording::close() {
  if (file_.empty())
    return {};
  const auto closed = writer_.close();
  const auto& counts = writer_.counts();
  std::string sentence = file_ + ": " + std::to_string(counts.frames_written) + " frames recorded";
  if (counts.keys_withheld != 0)
    sentence += ", " + std::to_string(counts.keys_withheld) + " with a key left out";
  if (counts.frames_lost != 0)
    sentence += ", " + std::to_string(counts.frames_lost) + " lost";
  return closed ? sentence : sentence + " (" + closed.error().message() + ")";
}

std::string tlog_recording::once(const io::mcap::result<void>& result) {
  if (result || told_)
    return {};
  told_ = true;
  return "the recording can not be written: " + result.error().message();
}

} // namespace godwit::trace_tool
