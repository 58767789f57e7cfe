// A process with an essential actor that hangs, or is given up, on command: tests/runtime/hang_test.cpp looks at how it
// ends.
//
//   hang_victim essential_hangs|all_hang|essential_given_up|stood_still|requested FOLDER
//
// First a deposit becomes durable and its receipt comes back ("acknowledged"); then what MODE says happens. The process
// leaves as every program of godwit does: wait_for_exit_request, print the reason, finish(exit_code_for(cause)).
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/process.hpp"
#include "tests/support/ledger.hpp"

namespace {

using namespace godwit;
using namespace godwit::runtime;
using namespace std::chrono_literals;

struct hang {
  static constexpr auto fields = io::table("test.hang");
};
struct fail {
  static constexpr auto fields = io::table("test.fail");
};

using sleeper_handle = mailbox<tells<hang>, tells<fail>>;

class sleeper final : public actor_base<sleeper_handle> {
public:
  using actor_base::actor_base;

protected:
  behavior_type handlers() override {
    return {on<hang>([](const hang&) {
              for (;;)
                std::this_thread::sleep_for(1h);
            }),
            on<fail>([](const fail&) { throw std::runtime_error("told to fail"); })};
  }
};

class bell final : public actor_base<tests::auditor_handle> {
public:
  bell(spawn_context context, std::atomic<bool>* rung) : actor_base(std::move(context)), rung_(rung) {}

protected:
  behavior_type handlers() override {
    return {on<tests::receipt>([this](const tests::receipt&) { rung_->store(true); }),
            on<tests::alarm>([](const tests::alarm&) {})};
  }

private:
  std::atomic<bool>* rung_;
};

// The whole process does not run for longer than the fatal limit, as on a machine that was suspended.
void stand_still() {
  const auto me = ::getpid();
  if (const auto helper = ::fork(); helper == 0) { // only what is safe in the child of a process with threads
    ::sleep(2);
    ::kill(me, SIGCONT);
    ::_exit(0);
  } else {
    ::raise(SIGSTOP);
    ::waitpid(helper, nullptr, 0);
  }
  std::this_thread::sleep_for(200ms); // ten periods, in which somebody might draw a wrong conclusion
}

int run(const std::string& mode, const std::filesystem::path& folder) {
  process_options options;
  options.journal.path = folder / "journal.db";
  options.trace.emplace();
  options.trace->folder = folder / "trace";
  options.actors.workers = 2;
  options.actors.ping = {.period = 20ms, .warn = 200ms, .fatal = 1s};
  options.actors.stop_timeout = 200ms;
  auto host = process::open(std::move(options));
  if (!host) {
    std::printf("%s\n", host.error().c_str());
    return static_cast<int>(exit_code::failed);
  }
  auto& actors = (*host)->actors();
  std::atomic<bool> rung{false};
  const child_policy essential{.essential = mode != "stood_still", .restart = {.intensity = 0}};
  const auto ear = actors.add<bell>({.name = "bell"}, {}, &rung);
  const auto ledger = actors.add<tests::ledger_actor>({.name = "ledger"}, {}, ear);
  const auto bed = actors.add<sleeper>({.name = "sleeper"}, essential);
  const auto other_bed = actors.add<sleeper>({.name = "other_sleeper"}, {});
  actors.start();
  auto gate = actors.make_gateway("main");
  gate.tell(ledger, tests::deposit{1, 10});
  while (!rung)
    std::this_thread::sleep_for(1ms);
  std::printf("acknowledged\n");

  if (mode == "essential_given_up") {
    gate.tell(bed, fail{});
  } else if (mode == "requested" || mode == "stood_still") {
    if (mode == "stood_still")
      stand_still();
    actors.request_exit({exit_cause::requested, "the test wants it"});
  } else {
    if (mode == "all_hang")
      gate.tell(other_bed, hang{});
    gate.tell(bed, hang{});
  }
  const auto why = actors.wait_for_exit_request();
  std::printf("%s: %s\n", std::string(io::name_of(why.cause)).c_str(), why.reason.c_str());
  return (*host)->finish(static_cast<int>(exit_code_for(why.cause)));
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr,
                 "usage: hang_victim essential_hangs|all_hang|essential_given_up|stood_still|requested FOLDER\n");
    return static_cast<int>(exit_code::usage);
  }
  return run(argv[1], argv[2]);
}
