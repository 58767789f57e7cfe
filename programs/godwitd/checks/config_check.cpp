#include "programs/godwitd/checks/config_check.hpp"

#include <utility>

#include "actors/mission_client/http_service.hpp"
#include "io/eyes/model_files.hpp"
#include "io/http/secret_file.hpp"
#include "io/mavlink/signing/key_file.hpp"
#include "programs/godwitd/accounts/account_file.hpp"
#include "programs/godwitd/checks/output_check.hpp"
#include "programs/godwitd/checks/start_checks.hpp"
#include "programs/godwitd/convert_command.hpp"

namespace godwit::daemon {

namespace {

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

// What would be reported only at the first connection.
void check_fleet(const fleet_link::settings& fleet, problem_list& to) {
  for (const auto* const file : {&fleet.ca_file, &fleet.certificate_file})
    if (!file->empty())
      (void)to.must_be_readable("broker", *file);
  for (const auto* const file : {&fleet.password_file, &fleet.key_file})
    if (!file->empty())
      if (const auto read = io::http::load_secret_file(*file, io::http::max_key_bytes, io::http::errc::token_file);
          !read)
        to.add("broker", read.error().message());
}

void check_inputs(const daemon_settings& wanted, problem_list& to) {
  if (wanted.service)
    check_service(*wanted.service, to);
  if (wanted.fleet)
    check_fleet(*wanted.fleet, to);
  if (!wanted.signing_key_file.empty())
    if (const auto key = io::mavlink::load_key_file(wanted.signing_key_file); !key)
      to.add("signing-key", key.error().message());
  if (const auto accounts = accounts::load(wanted.accounts_file); !accounts)
    to.add("accounts", accounts.error());
  else if (wanted.operators)
    if (const auto objection = operator_port::objection_to(*wanted.operators, !accounts->empty()))
      to.add("operator-listen", *objection);
  if (!wanted.mission_file.empty())
    if (const auto mission = load_mission_file(wanted.mission_file, wanted.allow_partial, wanted.allowed_commands);
        !mission)
      to.add("mission", mission.error());
  if (wanted.camera && !wanted.camera->model.empty())
    if (const auto model = io::eyes::read_model(wanted.camera->model); !model)
      to.add("camera", "camera.model: " + model.error());
  if (!wanted.sightings_file.empty() && wanted.sightings_file != "-")
    to.must_be_readable("sightings", wanted.sightings_file);
}

// What is on the disk from before.
void check_state(const daemon_settings& wanted, problem_list& to) {
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
  check_state(wanted, found);
  auto result = found.take();
  for (const auto& objection : {objection_to_clock(clock_now()), objection_to_limits(limits_now())})
    if (objection)
      result.push_back(*objection);
  return result;
}

} // namespace godwit::daemon
