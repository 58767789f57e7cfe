// What is to go into a bundle, and what is not and why.
//
// A part in which a secret stands is left out as a whole. Errors: none; what can not be read is left out. Blocks on the
// disk. Thread: one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "programs/godwit-trace/bundle/secret_guard.hpp"
#include "runtime/trace/reading/trace_files.hpp"

namespace godwit::trace_tool {

struct bundle_member {
  std::string name; // in the archive
  std::string what;
  std::filesystem::path file; // empty: `text`
  std::string text;
  std::uint64_t size_bytes = 0;
};

class bundle_plan {
public:
  // SECRETS must live longer.
  explicit bundle_plan(const secret_guard& secrets) : secrets_(secrets) {}

  void add_text(std::string name, std::string what, std::string text);
  // As long as FILE is now: it may be written on.
  void add_file(std::string name, std::string what, const std::filesystem::path& file);
  void leave_out(const std::string& what, const std::string& why) { left_out_.push_back(what + ": " + why); }

  [[nodiscard]] const std::vector<bundle_member>& members() const { return members_; }
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }
  // For people: each member with its size, and what is not there. HEAD stands above it.
  [[nodiscard]] std::string contents(const std::string& head) const;

private:
  const secret_guard& secrets_;
  std::vector<bundle_member> members_;
  std::vector<std::string> left_out_;
};

// Which starts of godwitd belong to one flight: a process that died in flight is started again within seconds.
//
// Thread: pure, but for reading the files.
struct run_times {
  std::uint64_t run = 0;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

inline constexpr std::int64_t longest_break_ns = 60'000'000'000;

// Of FILES, oldest run first. A run of which nothing can be read is left out.
[[nodiscard]] std::vector<run_times> times_of_runs(const std::vector<runtime::trace_file>& files);

// The runs that follow one another with breaks of at most `longest_break_ns`, and among which AT_NS is, or the newest
// ones. Empty: there is none then.
[[nodiscard]] std::vector<std::uint64_t> runs_of_flight(const std::vector<run_times>& runs,
                                                        std::optional<std::int64_t> at_ns);

} // namespace godwit::trace_tool
