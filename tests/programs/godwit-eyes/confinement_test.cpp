// What a helper can still do after it has shut itself in, tried in a child as whoever has taken over a decoder would.
#include "programs/godwit-eyes/confinement/confinement.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace godwit::eyes {
namespace confinement_test {

namespace fs = std::filesystem;
using io::video::camera_kind;

int error_of(bool is_done) { return is_done ? 0 : errno; }

int opening(const std::string& path, int how) { return error_of(::open(path.c_str(), how | O_CLOEXEC, 0600) >= 0); }

class eyes_confinement : public ::testing::Test {
protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "godwit_confined_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    fs::create_directories(folder_ / "state");
    std::ofstream(folder_ / "state/godwit.db") << "journal";
    std::ofstream(folder_ / "flight.mkv") << "recording";
    ::setenv("GST_REGISTRY", (folder_ / "cache/registry").c_str(), 1);
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // What ACT gives in a process that is confined for a camera; -1: it could not be confined.
  static int confined(const io::video::camera_uri& from, const std::string& record_folder,
                      const std::function<int()>& act) {
    const auto child = ::fork();
    if (child == 0)
      ::_exit(confine(from, record_folder) ? act() : 255);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) != 255 ? WEXITSTATUS(status) : -1;
  }
  static int confined(const std::function<int()>& act) {
    return confined(*io::video::parse_camera_uri("test://ball"), {}, act);
  }
  fs::path folder_;
};

TEST_F(eyes_confinement, the_state_folder_is_closed_for_reading_writing_and_making) {
  const auto journal = path("state/godwit.db");
  EXPECT_EQ(confined([&] { return opening(journal, O_RDONLY); }), EACCES);
  EXPECT_EQ(confined([&] { return opening(journal, O_WRONLY); }), EACCES);
  EXPECT_EQ(confined([&] { return opening(path("state/new"), O_WRONLY | O_CREAT); }), EACCES);
  EXPECT_EQ(confined([&] { return error_of(::unlink(journal.c_str()) == 0); }), EACCES);
  EXPECT_EQ(confined([&] { return error_of(::rename(journal.c_str(), path("cache/mine").c_str()) == 0); }) != 0, true);
  EXPECT_EQ(confined([&] { return error_of(::truncate(journal.c_str(), 0) == 0); }) != 0, true);
  EXPECT_EQ(confined([&] { return error_of(::chmod(journal.c_str(), 0666) == 0); }), EPERM);
  EXPECT_EQ(confined([&] { return opening("/etc/shadow", O_RDONLY); }), EACCES);
}

TEST_F(eyes_confinement, serial_lines_are_closed) {
  int master = -1;
  int line = -1;
  std::array<char, 100> name{};
  ASSERT_EQ(::openpty(&master, &line, name.data(), nullptr, nullptr), 0);
  EXPECT_EQ(confined([&] { return opening(name.data(), O_RDWR | O_NOCTTY); }), EACCES);
  const io::video::camera_uri camera{.kind = camera_kind::device, .where = name.data()};
  EXPECT_EQ(confined(camera, {}, [&] { return opening(name.data(), O_RDWR | O_NOCTTY); }), 0) << "the camera itself";
  if (fs::exists("/dev/ttyS0")) {
    EXPECT_EQ(confined(camera, {}, [] { return opening("/dev/ttyS0", O_RDWR | O_NOCTTY | O_NONBLOCK); }), EACCES);
  }
  ::close(master);
  ::close(line);
}

TEST_F(eyes_confinement, the_daemon_is_out_of_reach) {
  const auto daemon = ::getpid();
  EXPECT_EQ(confined([&] { return error_of(::kill(daemon, SIGTERM) == 0); }), EPERM);
  EXPECT_EQ(confined([] { return error_of(::kill(0, SIGCONT) == 0); }), EPERM) << "its group";
  EXPECT_EQ(confined([&] { return error_of(::ptrace(PTRACE_ATTACH, daemon, nullptr, nullptr) == 0); }), EPERM);
  EXPECT_EQ(confined([&] {
              const rlimit none{0, 0};
              return error_of(::prlimit(daemon, RLIMIT_NOFILE, &none, nullptr) == 0);
            }),
            EPERM);
  EXPECT_EQ(confined([&] { return error_of(::setpriority(PRIO_PROCESS, static_cast<id_t>(daemon), 19) == 0); }), EPERM);
  EXPECT_EQ(confined([&] {
              std::array<char, 8> bytes{};
              iovec here{bytes.data(), bytes.size()};
              iovec there{&folder_, bytes.size()};
              return error_of(::process_vm_readv(daemon, &here, 1, &there, 1, 0) >= 0);
            }),
            EPERM);
  EXPECT_EQ(confined([&] { return opening("/proc/" + std::to_string(daemon) + "/mem", O_RDONLY); }), EACCES);
  EXPECT_EQ(confined([] { return error_of(::socket(AF_UNIX, SOCK_STREAM, 0) >= 0); }), EACCES) << "its control socket";
  EXPECT_EQ(confined([] {
              std::array<int, 2> pair{};
              return error_of(::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0, pair.data()) == 0);
            }),
            EACCES);
}

TEST_F(eyes_confinement, the_network_is_open_for_a_camera_there_and_closed_for_another) {
  const auto act = [] { return error_of(::socket(AF_INET, SOCK_STREAM, 0) >= 0); };
  EXPECT_EQ(confined(act), EACCES);
  EXPECT_EQ(confined(*io::video::parse_camera_uri("rtsp://127.0.0.1:8554/main"), {}, act), 0);
}

TEST_F(eyes_confinement, what_it_needs_stays) {
  const auto recording = *io::video::parse_camera_uri("file://" + path("flight.mkv"));
  EXPECT_EQ(confined(recording, {}, [&] { return opening(path("flight.mkv"), O_RDONLY); }), 0);
  EXPECT_EQ(confined(recording, {}, [&] { return opening(path("flight.mkv"), O_RDWR); }), EACCES);
  const auto folder = path("recorded");
  EXPECT_EQ(confined(recording, folder, [&] { return opening(folder + "/new.mkv", O_RDWR | O_CREAT); }), 0);
  EXPECT_EQ(confined(recording, folder, [&] { return error_of(::unlink((folder + "/new.mkv").c_str()) == 0); }), 0);
  EXPECT_EQ(confined([&] { return opening(path("cache/registry"), O_RDWR | O_CREAT); }), 0);
  EXPECT_EQ(confined([] { return opening("/usr/bin/env", O_RDONLY); }), 0);
  EXPECT_EQ(confined([] {
              std::array<int, 2> pair{};
              return error_of(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()) == 0);
            }),
            0);
  EXPECT_EQ(confined([] { return error_of(::raise(0) == 0); }), 0) << "signals to itself";
  EXPECT_EQ(confined([] {
              rlimit now{};
              return error_of(::getrlimit(RLIMIT_DATA, &now) == 0);
            }),
            0);
}

TEST_F(eyes_confinement, a_camera_that_is_plugged_in_again_is_noticed) {
  const auto device = path("video0");
  io::video::camera_uri camera{.kind = camera_kind::device, .where = device};
  const device_identity absent(camera);
  EXPECT_FALSE(absent.is_replaced());
  std::ofstream(device) << "a camera";
  EXPECT_TRUE(absent.is_replaced());
  const device_identity known(camera);
  EXPECT_FALSE(known.is_replaced());
  fs::rename(device, path("gone"));
  EXPECT_FALSE(known.is_replaced()) << "it is away";
  std::ofstream(device) << "a camera";
  EXPECT_TRUE(known.is_replaced());
  EXPECT_FALSE(device_identity(*io::video::parse_camera_uri("test://ball")).is_replaced());
}

} // namespace confinement_test
} // namespace godwit::eyes
