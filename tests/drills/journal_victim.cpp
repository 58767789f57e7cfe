// Writes durable events from several threads until it is killed. Prints "ACTOR NUMBER" for each event after it was
// acknowledged: whoever has read that line may demand the event from the journal ever after.
//
// Usage: journal_victim JOURNAL
#include <atomic>
#include <cstdio>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "runtime/journal/sqlite_journal.hpp"

namespace {

using namespace godwit::runtime;

constexpr int actors = 8;
constexpr std::int64_t snapshot_every = 50;

// A line shorter than PIPE_BUF reaches the pipe whole or not at all.
void print_acknowledged(const std::string& actor, std::int64_t number) {
  const auto line = actor + " " + std::to_string(number) + "\n";
  if (::write(STDOUT_FILENO, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    std::_Exit(3); // nobody listens any more
}

journal_write next_write(const std::string& actor, std::uint64_t incarnation, std::int64_t number) {
  journal_write write;
  write.actor = actor;
  write.incarnation = incarnation;
  write.events = {{number, number, "counted", "{\"n\":" + std::to_string(number) + "}"}};
  write.effects = {{{number, 0}, "told", "{}", 0}};
  if (number > 1)
    write.released = {{number - 1, 0}};
  if (number % snapshot_every == 0)
    write.snapshot = snapshot_record{number, number, 1, "{\"count\":" + std::to_string(number) + "}"};
  return write;
}

void write_for_ever(sqlite_journal& journal, const std::string& actor) {
  const auto incarnation = journal.status().run;
  std::binary_semaphore answered{0};
  std::int64_t number = -1;
  journal.recover(actor, incarnation, [&](auto state) {
    number = state ? state->last_event : -1;
    answered.release();
  });
  answered.acquire();
  while (number >= 0) {
    auto write = next_write(actor, incarnation, ++number);
    bool durable = false;
    write.done = [&](const commit_result& result) {
      durable = result.has_value();
      answered.release();
    };
    if (!journal.submit(std::move(write)))
      break;
    answered.acquire();
    if (!durable)
      break;
    print_acknowledged(actor, number);
  }
  std::_Exit(4); // only SIGKILL ends this program in order
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: journal_victim JOURNAL\n");
    return 2;
  }
  auto journal = sqlite_journal::open({.path = argv[1]});
  if (!journal) {
    std::fprintf(stderr, "%s\n", journal.error().message().c_str());
    return 1;
  }
  std::vector<std::thread> threads;
  for (int i = 0; i < actors; ++i)
    threads.emplace_back([&, i] { write_for_ever(**journal, "actor_" + std::to_string(i)); });
  for (auto& thread : threads)
    thread.join();
}
