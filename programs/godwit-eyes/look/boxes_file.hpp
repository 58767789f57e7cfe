// What the detector found in each picture of a recording, as two tables of comma-separated values for whoever scores
// it: `frame,track,x,y,w,h,score` of all that was confirmed, in pixels of the picture, and `frame,usable` (1 or 0).
// Pictures count from 1. Nothing that is there is written over. Errors: a sentence. Thread: one.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include <tl/expected.hpp>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

class boxes_file {
public:
  // Without a name a table is not written.
  [[nodiscard]] tl::expected<void, std::string> open(const std::string& boxes, const std::string& use);
  void add(std::uint64_t picture, const verdict& seen);
  [[nodiscard]] tl::expected<void, std::string> close();

private:
  struct table {
    std::string path;
    std::ofstream file;
  };
  table boxes_;
  table use_;
};

} // namespace godwit::eyes
