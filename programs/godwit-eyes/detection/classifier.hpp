// What a thing is by its look: a net that the user brings is asked about the part of a picture around it.
//
// The net finds COCO's 80 classes in a picture and gives rows of 85 numbers: box, whether there is something, and a
// score of each class, as those of Darknet do, and YOLOv5 as ONNX. Of what it finds that counts which lies where the
// thing is and is about as large.
//
// Errors: a sentence without a full stop. Thread: one at a time; `use_one_thread` once in the process.
// Source: Redmon and Farhadi, YOLOv3 (2018); COCO's classes in the order of Darknet's coco.names.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "io/eyes/model_files.hpp"
#include "programs/godwit-eyes/detection/detector.hpp"

namespace godwit::eyes {

struct class_answer {
  object_class what = object_class::unknown;
  double score = 0; // 0..1
  pixel_box box;    // of what it has found; of something unknown none
};

class classifier {
public:
  static constexpr int input_px = 160;  // a side of what the net is given
  static constexpr double most_ms = 60; // of an answer: more would hold up the pictures
  static constexpr double least_score = 0.4;

  // Asks it twice, which shows that it can be understood and how long it takes.
  [[nodiscard]] static tl::expected<std::shared_ptr<classifier>, std::string> make(const io::eyes::model_files& from);
  ~classifier();
  classifier(const classifier&) = delete;
  classifier& operator=(const classifier&) = delete;

  [[nodiscard]] class_answer ask(const frame_view& picture, const pixel_box& about);

private:
  struct parts;
  explicit classifier(std::unique_ptr<parts> all);
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::eyes
