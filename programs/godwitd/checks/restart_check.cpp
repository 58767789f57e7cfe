#include "programs/godwitd/checks/restart_check.hpp"

#include <filesystem>

#include "programs/common/control_client.hpp"
#include "programs/godwitd/checks/restart_status.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/flight_actors.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon {

namespace {

std::string why_not_by_journal(const std::string& file) {
  if (!std::filesystem::exists(file))
    return {};
  auto journal = runtime::journal_reader::open(file);
  if (!journal)
    return "whether a flight is under way is not known: " + journal.error().message();
  const auto snapshot = journal->snapshot("executor");
  const auto events = snapshot ? journal->events("executor", *snapshot ? (*snapshot)->number : 0)
                               : tl::make_unexpected(snapshot.error());
  if (!events)
    return "whether a flight is under way is not known: " + events.error().message();
  runtime::recovered executor;
  executor.snapshot = *snapshot;
  executor.events = *events;
  return is_in_flight(executor) ? "godwitd does not run, and its journal has a flight that has not ended" : "";
}

} // namespace

std::string why_not_restart(const nlohmann::json& configuration) {
  const auto status = control::ask_daemon(control_path(configuration), {{"do", "status"}});
  return status ? why_not_restart_now(*status)
                : why_not_by_journal(runtime::journal_in_use(journal_path(configuration)));
}

} // namespace godwit::daemon
