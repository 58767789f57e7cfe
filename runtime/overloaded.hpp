// For std::visit: one function out of several, one for each kind. Thread: pure.
#pragma once

namespace godwit::runtime {

template <class... Fs>
struct overloaded : Fs... {
  using Fs::operator()...;
};

} // namespace godwit::runtime
