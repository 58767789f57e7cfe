// Records five seconds of pictures into the folder argv[1], says so with a byte on stdout, and waits to be killed.
#include <chrono>
#include <thread>

#include <unistd.h>

#include "io/video/jpeg_encoder.hpp"
#include "io/video/recorder.hpp"
#include "tests/io/video/painted_frame.hpp"

int main(int argc, char** argv) {
  using namespace godwit::io::video;
  if (argc != 2)
    return 2;
  recorder to({argv[1], 100'000'000});
  jpeg_encoder encoder(60);
  for (int i = 0; i < 100; ++i)
    to.add(encoder.encode(painted_frame(320, 240, static_cast<std::uint8_t>(40 + i), i)).value(), i * 50'000'000LL, 320,
           240);
  std::this_thread::sleep_for(std::chrono::milliseconds(500)); // the disk takes them in a thread of its own
  (void)!::write(STDOUT_FILENO, "x", 1);
  ::pause();
  return 0;
}
