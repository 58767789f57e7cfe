#include "programs/godwit-trace/bundle/bundle_plan.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

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

} // namespace godwit::trace_tool
