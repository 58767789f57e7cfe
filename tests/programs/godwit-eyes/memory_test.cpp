// Files of a few kB that announce pictures of gigabytes, and what godwit-eyes takes for them: as a process, by hand.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <turbojpeg.h>
#include <unistd.h>

#include "io/video/jpeg_encoder.hpp"
#include "io/video/recorder.hpp"
#include "tests/io/video/painted_frame.hpp"

namespace memory_test {

namespace io = godwit::io;

constexpr long most_kB = 100'000; // three times what it takes to start

constexpr long bound_kB = 700'000; // RLIMIT_DATA, and the programs' own files

// A JPEG of 64 x 64 pixels that says it has SIDE x SIDE.
std::string jpeg_that_says(int side, bool is_progressive) {
  constexpr int real_side = 64;
  std::vector<unsigned char> pixels(std::size_t{real_side} * real_side);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<unsigned char>(i * 7);
  unsigned char* made = nullptr;
  unsigned long size = 0;
  auto* const press = ::tjInitCompress();
  ::tjCompress2(press, pixels.data(), real_side, 0, real_side, TJPF_GRAY, &made, &size, TJSAMP_GRAY, 80,
                is_progressive ? TJFLAG_PROGRESSIVE : 0);
  std::string result(reinterpret_cast<const char*>(made), size);
  ::tjFree(made);
  ::tjDestroy(press);
  const auto frame = result.find(is_progressive ? "\xff\xc2" : "\xff\xc0");
  for (const std::size_t at : {frame + 5, frame + 7}) {
    result[at] = static_cast<char>(side / 256);
    result[at + 1] = static_cast<char>(side % 256);
  }
  return result;
}

struct run_result {
  std::string text;
  int status = 0;
  long most_resident_kB = 0;
};

run_result run(const std::vector<std::string>& arguments) {
  std::array<int, 2> pipe{};
  EXPECT_EQ(::pipe(pipe.data()), 0);
  const auto process = ::fork();
  if (process == 0) {
    ::dup2(pipe[1], STDOUT_FILENO);
    ::dup2(pipe[1], STDERR_FILENO);
    ::close(pipe[0]);
    ::close(pipe[1]);
    std::vector<char*> all{const_cast<char*>(GODWIT_EYES_PROGRAM)};
    for (const auto& each : arguments)
      all.push_back(const_cast<char*>(each.c_str()));
    all.push_back(nullptr);
    ::execv(all.front(), all.data());
    ::_exit(127);
  }
  ::close(pipe[1]);
  run_result result;
  std::array<char, 4096> piece{};
  for (ssize_t got = 0; (got = ::read(pipe[0], piece.data(), piece.size())) > 0;)
    result.text.append(piece.data(), static_cast<std::size_t>(got));
  ::close(pipe[0]);
  rusage used{};
  ::wait4(process, &result.status, 0, &used);
  result.most_resident_kB = used.ru_maxrss;
  return result;
}

class eyes_memory : public ::testing::Test {
protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "godwit_eyes_memory_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string store(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(eyes_memory, a_picture_that_is_too_large_is_refused_by_its_size_before_there_is_memory_for_it) {
  const auto file = store("large.jpg", jpeg_that_says(16'000, false));
  for (const auto& command : {std::vector<std::string>{"probe", "file://" + file, "--seconds", "2"}, {"look", file}}) {
    const auto seen = run(command);
    EXPECT_NE(seen.text.find("its pictures have 16000 x 16000 pixels"), std::string::npos) << seen.text;
    EXPECT_TRUE(WIFEXITED(seen.status)) << "it ends by itself";
    EXPECT_LT(seen.most_resident_kB, most_kB);
  }
}

TEST_F(eyes_memory, a_decoder_that_wants_all_of_it_first_gets_no_more_than_the_bound) {
  const auto file = store("progressive.jpg", jpeg_that_says(30'000, true));
  for (const auto& command : {std::vector<std::string>{"probe", "file://" + file, "--seconds", "2"}, {"look", file}})
    EXPECT_LT(run(command).most_resident_kB, bound_kB);
}

TEST_F(eyes_memory, a_large_picture_that_cameras_have_is_taken) {
  const auto file = store("usual.jpg", jpeg_that_says(4'000, false));
  const auto seen = run({"look", file});
  EXPECT_NE(seen.text.find("4000 x 4000"), std::string::npos) << seen.text;
}

// A few of them; GODWIT_MUTATIONS says how many (docs/performance.md).
TEST_F(eyes_memory, a_recording_with_any_bytes_changed_stays_within_the_bound) {
  {
    io::video::recorder to({(folder_ / "recorded").string(), 100'000'000});
    io::video::jpeg_encoder encoder(60);
    for (int i = 0; i < 20; ++i)
      to.add(encoder.encode(io::video::painted_frame(640, 360, static_cast<std::uint8_t>(40 + i), i)).value(),
             i * std::int64_t{50'000'000}, 640, 360);
  }
  const auto recorded = std::filesystem::directory_iterator(folder_ / "recorded")->path();
  std::ifstream from(recorded, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(from), {});
  const char* const asked = std::getenv("GODWIT_MUTATIONS");
  std::mt19937_64 random(35);
  long most_kB_seen = 0;
  int refused_memory = 0;
  for (auto left = asked == nullptr ? 8UL : std::stoul(asked); left > 0; --left) {
    auto changed = whole;
    // Headers, of the file and of the pictures, are a small part: half of the changes are at a marker of JPEG.
    for (auto changes = 1 + random() % 8; changes > 0; --changes) {
      auto at = random() % changed.size();
      if (random() % 2 == 0)
        at = std::min(changed.find("\xff\xc0", at), changed.size() - 12) + random() % 12;
      changed[at] = static_cast<char>(random());
    }
    const auto seen = run({"look", store("changed.mkv", changed)});
    // GLib ends a process that is refused memory.
    const bool is_refused_memory = seen.text.find("failed to allocate") != std::string::npos;
    EXPECT_TRUE(WIFEXITED(seen.status) || is_refused_memory) << seen.text;
    refused_memory += is_refused_memory ? 1 : 0;
    most_kB_seen = std::max(most_kB_seen, seen.most_resident_kB);
  }
  EXPECT_LT(most_kB_seen, bound_kB);
  std::printf("%d wanted more than the bound, ", refused_memory);
  std::printf("at most %ld kB resident\n", most_kB_seen);
}

TEST_F(eyes_memory, its_first_act_is_to_bound_itself_and_to_be_the_first_to_go) {
  const auto process = ::fork();
  if (process == 0) {
    ::execl(GODWIT_EYES_PROGRAM, "godwit-eyes", "probe", "test://ball", "--seconds", "60", nullptr);
    ::_exit(127);
  }
  std::string limits;
  std::string adjusted;
  for (int looks = 0; looks < 2'000 && adjusted != "1000"; ++looks) {
    ::poll(nullptr, 0, 5);
    std::ifstream("/proc/" + std::to_string(process) + "/oom_score_adj") >> adjusted;
    std::ifstream from("/proc/" + std::to_string(process) + "/limits");
    limits.assign(std::istreambuf_iterator<char>(from), {});
  }
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  EXPECT_EQ(adjusted, "1000");
#ifndef __SANITIZE_ADDRESS__
  EXPECT_TRUE(std::regex_search(limits, std::regex("Max data size +671088640 +671088640"))) << limits;
#endif
}

} // namespace memory_test
