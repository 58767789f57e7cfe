#include "programs/godwitd/daemon.hpp"

#include <cstdlib>
#include <filesystem>
#include <thread>

#include <unistd.h>

#include "programs/common/printable.hpp"
#include "programs/godwitd/checks/start_checks.hpp"
#include "programs/godwitd/console.hpp"
#include "programs/godwitd/privacy.hpp"
#include "programs/godwitd/service/crash_loop_guard.hpp"
#include "programs/godwitd/service/service_manager.hpp"
#include "programs/godwitd/service/signal_handler.hpp"

namespace godwit::daemon {
namespace {

using runtime::exit_code;

constexpr std::string_view part = "godwitd"; // in the log
// An end in order writes what waits, 5 s at most, and stops the actors; who takes longer hangs. Below TimeoutStopSec.
constexpr std::chrono::seconds longest_end{30};

// Whoever started it sees it on stderr, whoever looks for it later finds it in the log.
void complain(program_log& log, const std::string& sentence) {
  say(programs::printable(sentence));
  if (!log.is_plain())
    log.say(log_level::error, part, sentence);
}

service_manager manager_of(program_log& log) {
  auto found = service_manager::from_environment();
  if (!found)
    complain(log, found.error());
  return found ? *std::move(found) : service_manager();
}

void reopen(program_log& log) {
  if (log.file().empty()) {
    log.say(log_level::info, part, "SIGHUP: nothing to open anew, the log goes to standard output");
    return;
  }
  if (const auto done = log.reopen(); !done)
    complain(log, done.error() + "; the log goes on where it was");
  else
    log.say(log_level::info, part, "the log file is opened anew");
}

pulse_view view_of(runtime::process& host, program_log& log) {
  return {[&host] { return host.actors().has_begun(); }, [&host] { return host.actors().is_responsive(); },
          [&host] { return host.health().entries(); },
          [&log](const health_change& news) {
            log.say(news.colour == runtime::health_colour::red ? log_level::warning : log_level::info, news.part,
                    news.sentence);
          }};
}

// A new process cures more than an orderly end of this one, and a vehicle waits for it. The journal loses nothing by
// it.
void leave_by_force_soon(exit_code code, std::chrono::milliseconds after) {
  std::thread([code, after] {
    std::this_thread::sleep_for(after);
    std::_Exit(static_cast<int>(code));
  }).detach();
}

// Until the end is asked for: by a signal, the run itself or the guardian.
exit_code wait_for_end(composition& made, program_log& log, crash_loop_guard& ledger) {
  const auto why = made.host().actors().wait_for_exit_request();
  auto code = runtime::exit_code_for(why.cause);
  if (why.cause == runtime::exit_cause::given_up_in_flight) {
    ledger.end_fast(this_moment());
    leave_by_force_soon(code, runtime::fast_end);
  }
  const auto ended = made.end_of_run();
  if (code == exit_code::ok && ended && !ended->well)
    code = exit_code::failed;
  if (code != exit_code::ok)
    complain(log, ended && !ended->well ? ended->why : why.reason);
  else if (!ended)
    log.say(log_level::info, part, "ends: " + why.reason);
  return code;
}

// From all parts made to all parts closed.
exit_code run_made(composition& made, program_log& log, signal_handler& signals, crash_loop_guard& ledger) {
  const auto manager = manager_of(log);
  watchdog_notifier beats(manager, view_of(made.host(), log),
                          made.mission_id().empty() ? std::string() : "mission " + made.mission_id() + ": ");
  const struct before_they_go { // also a signal in the last moment must find them
    signal_handler& signals;
    ~before_they_go() { signals.end(); }
  } guard{signals};
  signals.start(
      [&made](const std::string& name) {
        made.host().actors().request_exit({runtime::exit_cause::requested, name});
      },
      [&made, &beats, &log] {
        beats.around_reload([&] {
          reopen(log);
          made.read_anew();
        });
      });
  auto code = exit_code::failed;
  if (const auto opened = made.open(); !opened) {
    complain(log, opened.error());
  } else {
    beats.start();
    code = wait_for_end(made, log, ledger);
    beats.end();
  }
  manager.tell_stopping();
  leave_by_force_soon(code, longest_end);
  if (code != exit_code::essential_given_up && code != exit_code::unresponsive)
    ledger.end_in_order(); // while the journal's lock is ours, and so the ledger
  return static_cast<exit_code>(made.close(code));
}

} // namespace

exit_code run_daemon(daemon_settings wanted, const add_more& more) {
  signal_handler signals; // before any thread
  keep_memory_private();
  for (const auto& objection : {objection_to_clock(clock_now()), objection_to_limits(limits_now())})
    if (objection) {
      say(*objection);
      return exit_code::failed;
    }
  const auto log = program_log::open(wanted.log, STDOUT_FILENO);
  if (!log) {
    say(log.error());
    return exit_code::failed;
  }
  const auto journal = wanted.process.journal.path;
  const auto map = wanted.map.store.file.path;
  crash_loop_guard ledger(std::filesystem::path(journal).replace_extension(".starts").string(), wanted.restarts);
  const auto is_beyond_us = [&] { return objection_to_journal(journal) || objection_to_map(map); };
  const auto made = composition::make(std::move(wanted), **log);
  if (!made) {
    complain(**log, made.error());
    return is_beyond_us() ? exit_code::unknown_state : exit_code::failed;
  }
  const auto verdict = ledger.begin(this_moment(), (*made)->is_in_flight());
  if (!verdict.may_start) {
    complain(**log, verdict.sentence);
    return static_cast<exit_code>((*made)->close(exit_code::unknown_state));
  }
  if (!verdict.sentence.empty())
    (*log)->say(log_level::warning, part, verdict.sentence);
  (*made)->set_circumstances({verdict.may_end_fast, verdict.is_reduced});
  if (more)
    more(**made);
  const auto code = run_made(**made, **log, signals, ledger);
  return code == exit_code::failed && is_beyond_us() ? exit_code::unknown_state : code;
}

} // namespace godwit::daemon
