#include "tests/support/eyes/small_net.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

namespace godwit::eyes::test {

namespace {

constexpr int box_values = 5; // middle, size, and whether there is something
constexpr int colours = 3;    // red, green, blue; each 0..1, the brightest of a cell
constexpr int there_is_something = 4;
constexpr int person = box_values;
constexpr int vehicle = box_values + 2; // a car
constexpr float steep = 40;             // of the step from no to yes
constexpr float bright = 0.6F;

template <class T>
void append(std::string& to, const T& value) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  to.append(bytes.data(), bytes.size());
}

} // namespace

io::eyes::model_files small_net(int classes) {
  const int rows = box_values + classes;
  const std::string filters = std::to_string(rows);
  io::eyes::model_files result;
  result.layers = "[net]\nwidth=160\nheight=160\nchannels=3\n"
                  "[maxpool]\nsize=32\nstride=32\npadding=0\n"
                  "[convolutional]\nsize=1\nstride=1\npad=1\nactivation=linear\nfilters=" +
                  filters + "\n[yolo]\nmask=0\nanchors=80,80\nnum=1\nclasses=" + std::to_string(classes) + "\n";
  std::vector<float> biases(static_cast<std::size_t>(rows), -steep);
  std::vector<std::array<float, colours>> weights(static_cast<std::size_t>(rows));
  for (int n = 0; n < there_is_something; ++n)
    biases[static_cast<std::size_t>(n)] = 0; // in the middle of its cell, as large as the anchor
  biases[there_is_something] = -bright * steep;
  weights[there_is_something] = {steep / 2, 0, steep / 2};
  biases[person] = 0.1F * steep;
  weights[person] = {steep, 0, -steep};
  if (vehicle < rows) {
    biases[vehicle] = -0.1F * steep;
    weights[vehicle] = {-steep, 0, steep};
  }
  for (const std::int32_t each : {0, 2, 0}) // version 0.2.0
    append(result.weights, each);
  append(result.weights, std::uint64_t{0}); // pictures that it has seen
  for (const float each : biases)
    append(result.weights, each);
  for (const auto& each : weights)
    append(result.weights, each);
  return result;
}

namespace {

// Protocol buffers, as far as ONNX needs them (onnx.proto3 has the numbers).
std::string varint(std::uint64_t value) {
  std::string result;
  for (; value >= 0x80; value >>= 7U)
    result += static_cast<char>((value & 0x7FU) | 0x80U);
  return result + static_cast<char>(value);
}
std::string number(unsigned field, std::uint64_t value) { return varint(field << 3U) + varint(value); }
std::string part(unsigned field, const std::string& bytes) {
  return varint((field << 3U) | 2U) + varint(bytes.size()) + bytes;
}
template <class T>
std::string tensor(const std::string& name, std::uint64_t type, const std::vector<std::uint64_t>& dimensions,
                   const std::vector<T>& values) {
  std::string result;
  for (const auto each : dimensions)
    result += number(1, each);
  std::string bytes;
  for (const auto& each : values)
    append(bytes, each);
  return part(5, result + number(2, type) + part(8, name) + part(9, bytes));
}
std::string numbers(const std::string& name, const std::vector<std::uint64_t>& values) {
  constexpr std::uint64_t integers = 7;
  std::string result = part(1, name);
  for (const auto each : values)
    result += number(8, each);
  return part(5, result + number(20, integers));
}
std::string node(const std::string& type, const std::vector<std::string>& from, const std::string& to,
                 const std::string& attributes = {}) {
  std::string result;
  for (const auto& each : from)
    result += part(1, each);
  return part(1, result + part(2, to) + part(3, to) + part(4, type) + attributes);
}
std::string value(unsigned field, const std::string& name, const std::vector<std::uint64_t>& dimensions) {
  std::string shape;
  for (const auto each : dimensions)
    shape += part(1, number(1, each));
  return part(field, part(1, name) + part(2, part(1, number(1, 1) + part(2, shape))));
}

} // namespace

io::eyes::model_files small_onnx() {
  constexpr std::uint64_t rows = 85;
  constexpr std::uint64_t cells = 25;
  constexpr float middle = 80;
  std::vector<float> biases(rows, 0);
  std::fill_n(biases.begin(), there_is_something, middle);
  biases[person] = 1;
  std::vector<float> weights(rows * colours, 0);
  weights[std::size_t{there_is_something} * colours] = 1; // as bright as it is in red
  const std::string graph =
      node("MaxPool", {"images"}, "cells", numbers("kernel_shape", {32, 32}) + numbers("strides", {32, 32})) +
      node("Conv", {"cells", "weights", "biases"}, "maps", numbers("kernel_shape", {1, 1})) +
      node("Reshape", {"maps", "shape"}, "columns") +
      node("Transpose", {"columns"}, "output", numbers("perm", {0, 2, 1})) + part(2, "small") +
      tensor("weights", 1, {rows, colours, 1, 1}, weights) + tensor("biases", 1, {rows}, biases) +
      tensor("shape", 7, {3}, std::vector<std::int64_t>{1, rows, cells}) + value(11, "images", {1, 3, 160, 160}) +
      value(12, "output", {1, cells, rows});
  return {"", number(1, 7) + part(8, number(2, 12)) + part(7, graph)};
}

std::string written(const io::eyes::model_files& net, const std::string& name) {
  std::ofstream(name + ".cfg") << net.layers;
  std::ofstream(name + ".weights") << net.weights;
  return name + ".weights";
}

} // namespace godwit::eyes::test
