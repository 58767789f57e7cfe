#include "programs/godwit-trace/bundle/bundle_plan.hpp"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "runtime/trace/reading/trace_reader.hpp"

namespace godwit::trace_tool {

namespace {

std::string because_of(const std::string& secret_file) { return "the secret of " + secret_file + " stands in it"; }

} // namespace

void bundle_plan::add_text(std::string name, std::string what, std::string text) {
  if (const auto found = secrets_.found_in(text); !found.empty()) {
    leave_out(name, because_of(found));
    return;
  }
  const auto size_bytes = text.size();
  members_.push_back({std::move(name), std::move(what), {}, std::move(text), size_bytes});
}

void bundle_plan::add_file(std::string name, std::string what, const std::filesystem::path& file) {
  std::error_code code;
  const auto size_bytes = std::filesystem::file_size(file, code);
  if (code) {
    leave_out(name, file.string() + ": " + code.message());
    return;
  }
  if (const auto found = secrets_.found_in_file(file, size_bytes); !found.empty()) {
    leave_out(name, found == file.string() ? file.string() + ": it can not be read" : because_of(found));
    return;
  }
  members_.push_back({std::move(name), std::move(what), file, {}, size_bytes});
}

std::string bundle_plan::contents(const std::string& head) const {
  std::string result = head;
  constexpr std::size_t width = 12;
  for (const auto& each : members_) {
    const auto size = std::to_string(each.size_bytes);
    result.append(width - std::min(width, size.size()), ' ').append(size).append("  ").append(each.name);
    result.append("  ").append(each.what).append("\n");
  }
  if (!left_out_.empty())
    result += "\nNot in it:\n";
  for (const auto& each : left_out_)
    result += "  " + each + "\n";
  return result;
}

namespace {

using runtime::trace_file;

// The first and the last file of a run are enough.
std::optional<run_times> times_of_run(std::uint64_t run, const std::vector<trace_file>& files) {
  std::optional<run_times> result;
  const auto note = [&](const trace_file& file, bool first_only) {
    runtime::name_table names;
    runtime::trace_reader reader({file}, names);
    for (runtime::delivery each; reader.next(each);) {
      if (!result)
        result = run_times{run, each.began_ns, each.began_ns};
      result->end_ns = std::max(result->end_ns, each.began_ns);
      if (first_only)
        break;
    }
  };
  note(files.front(), files.size() > 1);
  if (files.size() > 1)
    note(files.back(), false);
  return result;
}

} // namespace

std::vector<run_times> times_of_runs(const std::vector<trace_file>& files) {
  std::map<std::uint64_t, std::vector<trace_file>> by_run;
  for (const auto& each : files)
    by_run[each.run].push_back(each);
  std::vector<run_times> result;
  for (const auto& [run, of_run] : by_run)
    if (const auto times = times_of_run(run, of_run))
      result.push_back(*times);
  return result;
}

std::vector<std::uint64_t> runs_of_flight(const std::vector<run_times>& runs, std::optional<std::int64_t> at_ns) {
  std::vector<std::vector<run_times>> flights;
  for (const auto& each : runs) {
    if (flights.empty() || each.begin_ns - flights.back().back().end_ns > longest_break_ns)
      flights.emplace_back();
    flights.back().push_back(each);
  }
  const auto wanted = std::ranges::find_if(flights.rbegin(), flights.rend(), [&](const auto& flight) {
    return !at_ns || (flight.front().begin_ns <= *at_ns && *at_ns <= flight.back().end_ns);
  });
  std::vector<std::uint64_t> result;
  if (wanted != flights.rend())
    for (const auto& each : *wanted)
      result.push_back(each.run);
  return result;
}

} // namespace godwit::trace_tool
