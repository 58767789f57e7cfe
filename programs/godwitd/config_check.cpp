#include "programs/godwitd/config_check.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <unistd.h>

#include "actors/mission_client/http_service.hpp"
#include "io/http/secret_file.hpp"
#include "io/mavlink/signing/key_file.hpp"
#include "programs/godwitd/control/unix_address.hpp"
#include "programs/godwitd/convert_command.hpp"
#include "programs/godwitd/option_table.hpp"
#include "programs/godwitd/state_check.hpp"

namespace godwit::daemon {
namespace {

namespace fs = std::filesystem;

class problem_list {
public:
  void add(std::string_view option, const std::string& sentence) {
    list_.push_back(all_names_of(option) + ": " + sentence);
  }
  bool must_be_readable(std::string_view option, const std::string& file) {
    if (::access(file.c_str(), R_OK) == 0)
      return true;
    add(option, file + " can not be read: " + std::strerror(errno));
    return false;
  }
  // PATH, or the nearest folder above it that is there, when it is to be made.
  void must_be_writable(std::string_view option, const fs::path& path) {
    std::error_code ignored;
    auto there = fs::absolute(path);
    while (!fs::exists(there, ignored) && there.has_relative_path())
      there = there.parent_path();
    if (::access(there.c_str(), W_OK) != 0)
      add(option, there.string() + " can not be written: " + std::strerror(errno));
  }
  // FILE or, when it is to be made, its folder, which nobody makes.
  void must_have_folder(std::string_view option, const fs::path& file) {
    const auto folder = fs::absolute(file).parent_path();
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
      add(option, "there is no folder " + folder.string());
    else
      must_be_writable(option, file);
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(list_); }

private:
  std::vector<std::string> list_;
};

void check_service(const io::http::settings& service, problem_list& to) {
  auto rest = service;
  if (!service.token_file.empty())
    if (const auto token = io::http::load_token(service.token_file); !token) {
      to.add("token-file", token.error().message());
      rest.token_file.clear(); // said already
    }
  bool are_readable = true;
  for (const auto& [option, file] : {std::pair<std::string_view, const std::string&>("ca-file", service.ca_file),
                                     {"certificate-file", service.certificate_file},
                                     {"key-file", service.key_file}})
    are_readable &= file.empty() || to.must_be_readable(option, file);
  if (!are_readable)
    return;
  if (const auto opened = mission_client::http_service::open(rest); !opened)
    to.add("service", opened.error());
}

void check_inputs(const daemon_settings& wanted, problem_list& to) {
  if (wanted.service)
    check_service(*wanted.service, to);
  if (!wanted.signing_key_file.empty())
    if (const auto key = io::mavlink::load_key_file(wanted.signing_key_file); !key)
      to.add("signing-key", key.error().message());
  if (!wanted.mission_file.empty())
    if (const auto mission = load_mission_file(wanted.mission_file, wanted.allow_partial); !mission)
      to.add("mission", mission.error());
  if (!wanted.sightings_file.empty() && wanted.sightings_file != "-")
    to.must_be_readable("sightings", wanted.sightings_file);
}

void check_outputs(const daemon_settings& wanted, problem_list& to) {
  to.must_have_folder("journal", wanted.process.journal.path);
  to.must_be_writable("map", wanted.map.store.file.path);
  if (wanted.process.trace)
    to.must_be_writable("trace", wanted.process.trace->folder);
  if (!wanted.log.file.empty())
    to.must_have_folder("log-file", wanted.log.file);
  if (const auto address = control::unix_address(wanted.control_path); !address)
    to.add("control", address.error());
  if (const auto objection = objection_to_journal(wanted.process.journal.path))
    to.add("journal", *objection);
  if (const auto objection = objection_to_map(wanted.map.store.file.path))
    to.add("map", *objection);
}

} // namespace

std::vector<std::string> problems_of(const daemon_settings& wanted) {
  problem_list found;
  check_inputs(wanted, found);
  check_outputs(wanted, found);
  return found.take();
}

} // namespace godwit::daemon
