// Sentences about the program itself, for people, on stderr. Thread: any, a line at a time.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace godwit::eyes {

inline void say(std::string_view sentence) {
  const std::string whole = "godwit-eyes: " + std::string(sentence) + "\n";
  std::fwrite(whole.data(), 1, whole.size(), stderr);
}

} // namespace godwit::eyes
