#include "programs/godwit-drill/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace godwit::drill {

namespace {

constexpr std::uint64_t terminal_steps = 200; // redraws of the whole bar
constexpr std::uint64_t plain_steps = 10;
constexpr std::size_t width = 40; // characters

} // namespace

progress_bar::progress_bar(std::uint64_t total)
    : total_(std::max<std::uint64_t>(total, 1)), terminal_(::isatty(2) == 1) {}

void progress_bar::show(std::uint64_t done, const std::string& note) {
  const auto step = done * (terminal_ ? terminal_steps : plain_steps) / total_;
  if (step == drawn_step_)
    return;
  drawn_step_ = step;
  const auto percent = static_cast<unsigned>(done * 100 / total_);
  if (!terminal_) {
    std::fprintf(stderr, "%3u %%  %s\n", percent, note.c_str());
    return;
  }
  const auto filled = std::min<std::size_t>(width, done * width / total_);
  const auto bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fprintf(stderr, "\r[%s] %3u %%  %s   ", bar.c_str(), percent, note.c_str());
  std::fflush(stderr);
}

void progress_bar::finish() {
  if (terminal_)
    std::fputc('\n', stderr);
}

} // namespace godwit::drill
