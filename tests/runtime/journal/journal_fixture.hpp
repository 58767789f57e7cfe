// What the journal's tests share: a folder on a real disk, and the asynchronous interface made to wait.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "runtime/assert.hpp"
#include "runtime/journal/sqlite_journal.hpp"

namespace godwit::tests {

// A new folder beside the test program, and so in the build tree and on a disk; removed at the end.
class scratch_folder {
public:
  scratch_folder() {
    auto name =
        (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "scratch_XXXXXX").string(); // beside the test
    GODWIT_ASSERT(::mkdtemp(name.data()) != nullptr, "the current folder can be written");
    folder_ = name;
  }
  ~scratch_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

inline runtime::journal_write event_write(const std::string& actor, std::int64_t number,
                                          std::uint64_t incarnation = 1) {
  runtime::journal_write write;
  write.actor = actor;
  write.incarnation = incarnation;
  write.events = {{number, 1'000 + number, "moved", "{\"n\":" + std::to_string(number) + "}"}};
  return write;
}

inline runtime::effect_record effect_of(std::int64_t event, std::uint32_t n) { return {{event, n}, "told", "{}", 7}; }

inline std::future<runtime::commit_result> submit(runtime::journal& journal, runtime::journal_write write) {
  auto answer = std::make_shared<std::promise<runtime::commit_result>>();
  auto future = answer->get_future();
  write.done = [answer](const runtime::commit_result& result) { answer->set_value(result); };
  if (auto taken = journal.submit(std::move(write)); !taken)
    answer->set_value(tl::unexpected(taken.error()));
  return future;
}

inline runtime::commit_result commit(runtime::journal& journal, runtime::journal_write write) {
  return submit(journal, std::move(write)).get();
}

using recovery = tl::expected<runtime::recovered, runtime::journal_error>;

inline std::future<recovery> start_recovery(runtime::journal& journal, const std::string& actor,
                                            std::uint64_t incarnation) {
  auto answer = std::make_shared<std::promise<recovery>>();
  auto future = answer->get_future();
  journal.recover(actor, incarnation, [answer](recovery state) { answer->set_value(std::move(state)); });
  return future;
}

inline recovery recover(runtime::journal& journal, const std::string& actor, std::uint64_t incarnation = 1) {
  return start_recovery(journal, actor, incarnation).get();
}

inline std::unique_ptr<runtime::sqlite_journal> open_journal(const runtime::journal_options& options) {
  auto opened = runtime::sqlite_journal::open(options);
  EXPECT_TRUE(opened.has_value()) << (opened ? "" : opened.error().message());
  return opened ? std::move(*opened) : nullptr;
}

// The error of an open that must fail; it names the file and a remedy.
inline runtime::journal_error refused_open(const runtime::journal_options& options) {
  const auto& path = options.path;
  auto opened = runtime::sqlite_journal::open(options);
  EXPECT_FALSE(opened.has_value());
  if (opened)
    return {};
  EXPECT_EQ(opened.error().file, path);
  EXPECT_FALSE(opened.error().what.empty());
  EXPECT_FALSE(opened.error().remedy.empty());
  return opened.error();
}

inline bool wait_for(const std::function<bool()>& condition) {
  for (int i = 0; i < 5'000 && !condition(); ++i)
    ::usleep(1'000);
  return condition();
}

} // namespace godwit::tests
