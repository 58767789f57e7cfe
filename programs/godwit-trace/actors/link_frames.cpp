#include "programs/godwit-trace/actors/link_frames.hpp"

#include <algorithm>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "io/text.hpp"
#include "io/time_units.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/message_forms.hpp"

namespace godwit::trace_tool {

namespace {

namespace fs = std::filesystem;

// LINK-RUN-NUMBER.tlog
std::optional<link_file> link_file_named(const fs::path& path) {
  const auto name = path.stem().string();
  const auto second = name.rfind('-');
  const auto first = second == std::string::npos || second == 0 ? std::string::npos : name.rfind('-', second - 1);
  link_file result{path, name.substr(0, first), 0, 0};
  if (path.extension() != ".tlog" || first == std::string::npos || first == 0 ||
      !io::read_number(std::string_view(name).substr(first + 1, second - first - 1), result.run) ||
      !io::read_number(std::string_view(name).substr(second + 1), result.number))
    return std::nullopt;
  return result;
}

// Damage that is worth a word; the end of a file that is being written is none.
std::string sentence_about(const std::string& file, const io::mavlink::tlog_counts& counts) {
  const auto broken = counts.bad_checksums + counts.not_frames + counts.unknown_flags + counts.v1_frames;
  return broken == 0
             ? std::string()
             : file + ": passed over " + std::to_string(broken) + " broken records; `godwit-trace tlog` shows more";
}

} // namespace

void add_link_arguments(CLI::App& command, link_arguments& to) {
  command.add_flag(
      "--links", to.links,
      "Also what went over the links to the vehicle and to ground stations, from the .tlog files beside it");
  command.add_option("--name", to.names, "Of these only messages with these names, such as COMMAND_*,MISSION_*")
      ->allow_extra_args(false)
      ->needs("--links")
      ->type_name("NAME,...");
}

std::vector<link_file> find_link_files(const std::vector<runtime::trace_file>& trace) {
  std::set<fs::path> folders;
  std::set<std::uint64_t> runs;
  for (const auto& each : trace) {
    folders.insert(each.path.parent_path());
    runs.insert(each.run);
  }
  std::vector<link_file> result;
  for (const auto& folder : folders) {
    std::error_code code;
    for (fs::directory_iterator each(folder.empty() ? fs::path(".") : folder, code), end; !code && each != end;
         each.increment(code))
      if (auto found = link_file_named(each->path()); found && runs.contains(found->run))
        result.push_back(*std::move(found));
  }
  std::ranges::sort(result, {}, [](const link_file& each) { return std::tie(each.link, each.run, each.number); });
  return result;
}

link_frames::link_frames(const std::vector<link_file>& files, runtime::time_span_ns span, name_filter wanted)
    : span_(span), wanted_(std::move(wanted)) {
  for (const auto& each : files) {
    if (streams_.empty() || streams_.back().files.back().link != each.link)
      streams_.emplace_back();
    streams_.back().files.push_back(each);
  }
}

std::optional<link_frame> link_frames::next_until(std::uint64_t run, std::int64_t at_ns) {
  const auto key = [](const stream& each) { return std::pair(each.next->run, each.next->at_ns); };
  stream* oldest = nullptr;
  for (auto& each : streams_) {
    read_on(each);
    if (each.next && (oldest == nullptr || key(each) < key(*oldest)))
      oldest = &each;
  }
  if (oldest == nullptr || key(*oldest) > std::pair(run, at_ns))
    return std::nullopt;
  oldest->is_read = false;
  return std::exchange(oldest->next, std::nullopt);
}

void link_frames::read_on(stream& from) {
  while (!from.is_read) {
    const auto record = next_record(from);
    if (!record) {
      from.is_read = true;
      return;
    }
    const auto at_ns = static_cast<std::int64_t>(record->timestamp_us) * ns_per_us;
    if (!span_.contains(at_ns) || !wanted_.wants(record->frame.id()))
      continue;
    const auto& file = from.files.front();
    from.next = link_frame{file.run, at_ns, &file.link, record->frame};
    from.is_read = true;
  }
}

std::optional<io::mavlink::tlog_record> link_frames::next_record(stream& from) {
  while (!from.files.empty()) {
    if (!from.reader && !open_first(from))
      continue;
    const auto record = from.reader->next();
    if (record && *record)
      return **record;
    if (!record)
      problems_.push_back(from.files.front().path.string() + ": " + record.error().what);
    close_first(from);
  }
  return std::nullopt;
}

bool link_frames::open_first(stream& from) {
  from.source = std::make_unique<io::mcap::file_source>();
  if (const auto opened = from.source->open(from.files.front().path); !opened) {
    problems_.push_back(opened.error().message());
    from.files.pop_front();
    return false;
  }
  from.reader = std::make_unique<io::mavlink::tlog_reader>(*from.source);
  return true;
}

void link_frames::close_first(stream& from) {
  if (auto sentence = sentence_about(from.files.front().path.string(), from.reader->counts()); !sentence.empty())
    problems_.push_back(std::move(sentence));
  from.reader.reset();
  from.source.reset();
  from.files.pop_front();
}

tl::expected<link_frames, std::string> open_links(const link_arguments& given, const opened_trace& trace) {
  auto names = name_filter::parse(given.names);
  if (!names)
    return tl::make_unexpected("--name: " + names.error());
  if (!given.links)
    return link_frames({}, trace.span, *std::move(names));
  const auto files = find_link_files(trace.reader.files());
  link_frames result(files, trace.span, *std::move(names));
  if (files.empty())
    result.add_problem("there is no .tlog of these runs beside the trace; trace.links of godwitd may be off");
  return result;
}

void report_problems(const link_frames& frames, console& to) {
  for (const auto& each : frames.problems())
    to.say(each);
}

void append_frame_line(std::string& out, const link_frame& each) {
  append_utc_ns(out, each.at_ns);
  out.append(" ").append(*each.link).append(" link <- ").append(std::to_string(each.frame.from().system));
  out.append("/").append(std::to_string(each.frame.from().component)).append(" ");
  append_message_text(out, each.frame);
  out += '\n';
}

void append_frame_json_line(std::string& out, const link_frame& each) {
  out.append(R"({"time":")").append(utc_ns(each.at_ns));
  out.append(R"(","time_ns":)").append(std::to_string(each.at_ns));
  out.append(R"(,"run":)").append(std::to_string(each.run));
  out.append(R"(,"link":")").append(*each.link).append(R"(","frame":)");
  append_message_json(out, static_cast<std::uint64_t>(each.at_ns / ns_per_us), each.frame);
  out += "}\n";
}

} // namespace godwit::trace_tool
