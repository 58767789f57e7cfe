// An open descriptor with one owner, who closes it. Thread: plain value.
#pragma once

#include <utility>

#include <unistd.h>

namespace godwit::io::link {

class descriptor {
public:
  descriptor() = default;
  explicit descriptor(int number) : number_(number) {}
  ~descriptor() { reset(); }
  descriptor(descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  descriptor& operator=(descriptor&& other) noexcept {
    if (this != &other) {
      reset();
      number_ = std::exchange(other.number_, -1);
    }
    return *this;
  }

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }
  // The caller closes it now.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }
  void reset() {
    if (is_open())
      static_cast<void>(::close(std::exchange(number_, -1)));
  }

private:
  int number_ = -1;
};

} // namespace godwit::io::link
