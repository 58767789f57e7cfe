// Commits a number of groups one after the other and prints how many commits the journal counted. sync_counter.sh
// compares that with the syncs that the kernel saw.
//
// Usage: journal_sync_counter JOURNAL COMMITS
#include <cstdio>
#include <cstdlib>
#include <semaphore>

#include "runtime/journal/sqlite_journal.hpp"

int main(int argc, char** argv) {
  using namespace godwit::runtime;
  if (argc != 3) {
    std::fprintf(stderr, "usage: journal_sync_counter JOURNAL COMMITS\n");
    return 2;
  }
  auto journal = sqlite_journal::open({.path = argv[1]});
  if (!journal) {
    std::fprintf(stderr, "%s\n", journal.error().message().c_str());
    return 1;
  }
  const auto commits = std::atoll(argv[2]);
  for (std::int64_t number = 1; number <= commits; ++number) {
    std::binary_semaphore answered{0};
    journal_write write;
    write.actor = "counter";
    write.events = {{number, number, "counted", "{}"}};
    write.done = [&](const commit_result&) { answered.release(); };
    if (!(*journal)->submit(std::move(write)))
      return 1;
    answered.acquire();
  }
  std::printf("%llu\n", static_cast<unsigned long long>((*journal)->status().commits));
}
