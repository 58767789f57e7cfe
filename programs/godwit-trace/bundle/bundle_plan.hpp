// What is to go into a bundle, and what is not and why.
//
// A part in which a secret stands is left out as a whole. Errors: none; what can not be read is left out. Blocks on the
// disk. Thread: one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "programs/godwit-trace/bundle/secret_guard.hpp"

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

} // namespace godwit::trace_tool
