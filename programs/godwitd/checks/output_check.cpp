#include "programs/godwitd/checks/output_check.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <unistd.h>

#include "programs/common/control_client.hpp"
#include "programs/godwitd/configuration.hpp"

namespace godwit::daemon {

namespace fs = std::filesystem;

void problem_list::add(std::string_view option, const std::string& sentence) {
  list_.push_back(all_names_of(option) + ": " + sentence);
}

bool problem_list::must_be_readable(std::string_view option, const std::string& file) {
  if (::access(file.c_str(), R_OK) == 0)
    return true;
  add(option, file + " can not be read: " + std::strerror(errno));
  return false;
}

void problem_list::must_be_writable(std::string_view option, const fs::path& path) {
  std::error_code ignored;
  auto there = fs::absolute(path);
  while (!fs::exists(there, ignored) && there.has_relative_path())
    there = there.parent_path();
  if (there != fs::absolute(path) && !fs::is_directory(there, ignored))
    add(option, there.string() + " is no folder");
  else if (::access(there.c_str(), W_OK) != 0)
    add(option, there.string() + " can not be written: " + std::strerror(errno));
}

void problem_list::must_have_folder(std::string_view option, const fs::path& file) {
  const auto folder = fs::absolute(file).parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    add(option, "there is no folder " + folder.string());
  else
    must_be_writable(option, file);
}

void problem_list::must_be_no_file(std::string_view option, const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_directory(path, ignored))
    add(option, path.string() + " is there and is no folder");
}

void problem_list::must_be_no_folder(std::string_view option, const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    add(option, path.string() + " is a folder");
}

namespace {

void check_control(const std::string& path, const fs::path& journal, problem_list& to) {
  if (const auto address = control::unix_address(path); !address)
    return to.add("control", address.error());
  std::error_code ignored;
  const auto there = fs::symlink_status(path, ignored);
  if (fs::exists(there) && !fs::is_socket(there))
    return to.add("control", path + " is there and is no socket");
  const auto folder = fs::absolute(path).parent_path();
  if (folder != fs::absolute(journal).parent_path()) // said already
    to.must_have_folder("control", folder / ".");    // a name is made in it
}

// By whatever name: links are followed, also where the file itself is not there yet.
fs::path real_path(const std::string& path) {
  constexpr int most_links = 8; // of links to links
  std::error_code failed;
  auto there = fs::absolute(path);
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(there, failed)); ++i)
    there = there.parent_path() / fs::read_symlink(there, failed); // an absolute one replaces all of it
  const auto result = fs::weakly_canonical(there, failed);
  return failed ? there.lexically_normal() : result;
}

// Files that godwitd makes for itself, each under its option.
void check_each_its_own(const daemon_settings& wanted, problem_list& to) {
  const auto& journal = wanted.process.journal.path;
  const std::array<std::pair<std::string_view, std::string>, 6> files{{
      {"journal", journal},
      {"journal", fs::path(journal).replace_extension(".starts").string()},
      {"map", wanted.map.store.file.path},
      {"control", wanted.control_path},
      {"log-file", wanted.log.file},
      {"trace", wanted.process.trace ? wanted.process.trace->folder.string() : std::string()},
  }};
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = i + 1; j < files.size(); ++j)
      if (!files[i].second.empty() && !files[j].second.empty() &&
          real_path(files[i].second) == real_path(files[j].second))
        to.add(files[j].first, files[j].second + " is that of --" + std::string(files[i].first) + " already");
}

// One address can be listened on once, and one serial line be opened once.
bool is_taken_by(const io::link::uri& one, const io::link::uri& other) {
  if (one.which != other.which)
    return false;
  if (one.which == io::link::uri::kind::serial)
    return real_path(one.device) == real_path(other.device);
  const auto is_any = [](const std::string& host) { return host.empty() || host == "0.0.0.0" || host == "::"; };
  return one.listens() && one.port != 0 && one.port == other.port &&
         (one.host == other.host || is_any(one.host) || is_any(other.host));
}

void check_lines(const daemon_settings& wanted, problem_list& to) {
  if (wanted.ground && wanted.flies && is_taken_by(*wanted.ground, wanted.vehicle))
    to.add("ground", wanted.ground->text() + " is taken: it is the line to the vehicle, " + wanted.vehicle.text());
}

} // namespace

void check_outputs(const daemon_settings& wanted, problem_list& to) {
  const auto& journal = wanted.process.journal.path;
  to.must_have_folder("journal", journal);
  to.must_be_no_folder("journal", journal);
  to.must_be_writable("map", wanted.map.store.file.path);
  to.must_be_no_folder("map", wanted.map.store.file.path);
  if (wanted.process.trace) {
    to.must_be_writable("trace", wanted.process.trace->folder);
    to.must_be_no_file("trace", wanted.process.trace->folder);
  }
  if (!wanted.log.file.empty()) {
    to.must_have_folder("log-file", wanted.log.file);
    to.must_be_no_folder("log-file", wanted.log.file);
  }
  check_control(wanted.control_path, journal, to);
  check_each_its_own(wanted, to);
  check_lines(wanted, to);
}

} // namespace godwit::daemon
