// Whether the files, folders and addresses of a configuration can be used, and are used for one thing each.
//
// Nothing is made. Thread: the caller's; looks at the disk.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "programs/godwitd/settings.hpp"

namespace godwit::daemon {

// Sentences, each with the names of the option that it is about in front.
class problem_list {
public:
  void add(std::string_view option, const std::string& sentence);
  bool must_be_readable(std::string_view option, const std::string& file);
  // PATH, or the nearest folder above it that is there, when it is to be made.
  void must_be_writable(std::string_view option, const std::filesystem::path& path);
  // FILE or, when it is to be made, its folder, which nobody makes.
  void must_have_folder(std::string_view option, const std::filesystem::path& file);
  // PATH is a folder, or not there yet; a file is in the way.
  void must_be_no_file(std::string_view option, const std::filesystem::path& path);
  void must_be_no_folder(std::string_view option, const std::filesystem::path& path);
  [[nodiscard]] std::vector<std::string> take() { return std::move(list_); }

private:
  std::vector<std::string> list_;
};

void check_outputs(const daemon_settings& wanted, problem_list& to);

} // namespace godwit::daemon
