// A net of Darknet for tests: two layers and some hundred weights, made here. It recognises what is bright in red or
// blue: a person where it is not bluer than red, else a vehicle. Thread: pure.
#pragma once

#include <string>

#include "io/eyes/model_files.hpp"

namespace godwit::eyes::test {

// CLASSES: other than 80 is one that can not be used.
[[nodiscard]] io::eyes::model_files small_net(int classes = 80);

// As ONNX, with boxes in pixels as those of YOLOv5: what is bright in red is a person, as large as half of the input.
[[nodiscard]] io::eyes::model_files small_onnx();

// Writes NAME.cfg and NAME.weights, and returns the name of the latter.
std::string written(const io::eyes::model_files& net, const std::string& name);

} // namespace godwit::eyes::test
